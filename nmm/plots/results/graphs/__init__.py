"""Numbers of a run as graphs: columns against time or one another, response spectra.

Fields over the bodies are one folder up.
"""
