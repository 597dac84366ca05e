"""x' = A x + b u, y = C x + d u, diagonalised."""

from dataclasses import dataclass

import numpy as np

from drivers.arrays import Array, Complex
from drivers.simulated.plant.one_thread import one_thread


@dataclass(frozen=True)
class Diagonal:
    """A linear system by its poles. Physical states keep their meaning from one system to the next."""

    poles: Complex
    """All of them, in rad/s. Shape (n,)."""
    to_modal: Complex
    """Modal from physical states. Shape (n, n)."""
    from_modal: Complex
    """Physical from modal states. Shape (n, n)."""
    b: Complex
    """Input to each modal state. Shape (n,)."""
    C: Complex
    """Outputs from modal states. Shape (outputs, n)."""
    d: Array
    """Outputs from the input. Shape (outputs,)."""
    names: tuple[str, ...]
    """Of the outputs."""

    def transfer(self, s: complex) -> Complex:
        """Outputs per unit of input e^{s t}. Shape (outputs,)."""
        return np.asarray(self.C @ (self.b / (s - self.poles)) + self.d)

    def transfer_rate(self, s: complex) -> Complex:
        """Derivative of `transfer` with respect to s. Shape (outputs,)."""
        return np.asarray(-self.C @ (self.b / (s - self.poles) ** 2))


@one_thread
def diagonalised(A: Array, b: Array, C: Array, d: Array, scale: Array, names: tuple[str, ...]) -> Diagonal:
    """From matrices in scaled states; `scale` makes them from physical ones. C reads scaled states.

    Shapes as `Diagonal` has them.
    """
    eigenvalues, vectors = np.linalg.eig(A)
    poles, X = eigenvalues.astype(np.complex128), vectors.astype(np.complex128)
    inverse: Complex = np.linalg.inv(X).astype(np.complex128)
    back = np.asarray(np.linalg.solve(scale, X), dtype=np.complex128)
    to_modal = np.asarray(inverse @ scale, dtype=np.complex128)
    b_modal = np.asarray(inverse @ b, dtype=np.complex128)
    return Diagonal(poles, to_modal, back, b_modal, np.asarray(C @ X), np.asarray(d, dtype=float), names)
