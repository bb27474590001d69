"""Linear maps of the plane in complex numbers: ``z -> a z + b conj(z)`` with ``z = x + iy``.

Two complex numbers hold the same as a 2 x 2 matrix, but rotation and size are read off at sight:
``a`` turns and scales, ``b`` stretches, and a rotation on the left multiplies both. Stacks of them
are plain arrays, several times as quick as stacks of small matrices.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from shapetween.base.arrays import Complex, Floats, Points

__all__ = ["LinearMaps", "as_complex", "as_points", "squared"]


def as_complex(points: Points) -> Complex:
    """Points (..., 2) as complex numbers, (...,)."""
    return np.ascontiguousarray(points).view(np.complex128)[..., 0]


def as_points(numbers: Complex) -> Points:
    """Complex numbers (...,) as points, (..., 2)."""
    return np.ascontiguousarray(numbers).view(np.float64).reshape(*numbers.shape, 2)


def squared(numbers: Complex) -> Floats:
    """Squared absolute values, without the root that `abs` takes."""
    return np.asarray(numbers.real**2 + numbers.imag**2)


@dataclass(frozen=True, slots=True, eq=False)
class LinearMaps:
    """A stack of linear maps ``z -> a z + b conj(z)``.

    Attributes
    ----------
    a, b : (...,) complex128

    Examples
    --------
    >>> stretch = LinearMaps.of(np.array([[2.0, 0.0], [0.0, 1.0]]))
    >>> print(complex(stretch.a), complex(stretch.b), float(stretch.determinants))
    (1.5+0j) (0.5+0j) 2.0
    """

    a: Complex
    b: Complex

    @classmethod
    def of(cls, matrices: Floats) -> "LinearMaps":
        """From matrices (..., 2, 2) that act on column vectors."""
        columns = as_complex(np.swapaxes(matrices, -1, -2))  # images of 1 and of i
        first, second = columns[..., 0], 1j * columns[..., 1]
        return cls((first - second) / 2, (first + second) / 2)

    @property
    def matrices(self) -> Floats:
        """As matrices, (..., 2, 2)."""
        plus, minus = self.a + self.b, self.a - self.b
        rows = [[plus.real, -minus.imag], [plus.imag, minus.real]]
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    @property
    def determinants(self) -> Floats:
        """Determinants, (...,)."""
        return squared(self.a) - squared(self.b)

    @property
    def squares(self) -> Floats:
        """Sums of the matrices' squared entries, (...,)."""
        return 2 * (squared(self.a) + squared(self.b))

    @property
    def angles(self) -> Floats:
        """Angle in (-pi, pi] of the rotation nearest to each, (...,)."""
        return np.asarray(np.angle(self.a))

    def __call__(self, vectors: Complex) -> Complex:
        """Images of vectors, whose shape the maps' own is to fit."""
        images = np.asarray(self.a * vectors)
        images += self.b * vectors.conj()
        return images

    def __getitem__(self, index: Any) -> "LinearMaps":
        """Some of the stack, by whatever an array may be indexed with."""
        return LinearMaps(self.a[index], self.b[index])

    def after(self, first: "LinearMaps") -> "LinearMaps":
        """The maps that do `first` and then these."""
        return LinearMaps(
            self.a * first.a + self.b * first.b.conj(),
            self.a * first.b + self.b * first.a.conj(),
        )

    def turned(self, factors: Complex | Floats) -> "LinearMaps":
        """These and then a rotation, a scaling or both, as complex factors."""
        return LinearMaps(np.asarray(factors * self.a), np.asarray(factors * self.b))

    def inverse(self) -> "LinearMaps":
        """The maps back; none may have a determinant of 0."""
        size = self.determinants
        return LinearMaps(self.a.conj() / size, -self.b / size)

    def between(self, angles: Floats, t: Floats) -> "LinearMaps":
        """Maps ``R(t angle) ((1 - t) I + t S)`` on the way from the identity to these, (F, ...).

        Parameters
        ----------
        angles : (...,) float64
            Angles of these, whole turns included; S is what is left without them.
        t : (F,) float64
        """
        time = t.reshape(-1, *(1,) * self.a.ndim)
        back = np.exp(-1j * angles)
        turn = np.exp(1j * time * angles)
        return LinearMaps(
            turn * ((1 - time) + time * (back * self.a)), turn * (time * back * self.b)
        )
