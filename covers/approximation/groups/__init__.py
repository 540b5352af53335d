"""Elements whose approximation has the same shape: values, gradients, integrals."""
