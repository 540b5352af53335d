"""Elastic and plastic bodies without contact: patch tests, rates of convergence, stress."""
