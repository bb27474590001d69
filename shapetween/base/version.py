"""Which version of the package this is."""

__all__ = ["installed_version"]


def installed_version() -> str:
    """The version as installed; "unknown" in a checkout that never was."""
    from importlib.metadata import PackageNotFoundError, version  # slow to import

    try:
        return version("shapetween")
    except PackageNotFoundError:
        return "unknown"
