"""From manifold elements to sparse matrices and force vectors."""
