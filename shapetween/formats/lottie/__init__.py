"""Movements as Lottie: JSON, or a .lottie file around it.

.. [Lottie] Lottie Animation Community, *Lottie specification*, version 1.0.
"""
