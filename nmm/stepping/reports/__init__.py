"""What a run hands over: frames, history, energies booked step by step.

Files are written in `results`.
"""
