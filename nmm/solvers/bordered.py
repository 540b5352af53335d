"""Systems with conditions held by multipliers."""

from scipy.sparse import csc_array, csr_array, hstack, vstack


def bordered(matrix: csc_array, rows: csr_array) -> csc_array:
    """Return ``[[A, C^T], [C, 0]]`` of a matrix (n, n) and the rows ``C`` (k, n) of conditions."""
    k = rows.shape[0]
    upper = hstack([matrix, csr_array(rows.T)])
    lower = hstack([rows, csr_array((k, k))])
    return csc_array(vstack([upper, lower]))
