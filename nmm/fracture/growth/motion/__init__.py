"""Crack growth in time: speed and energy of tips that run, branches, and tractions they release."""
