"""What drives steps: time, growing loads; and how a run ends.

One step is in `step`; paths are in `control`.
"""
