"""What drives steps: time, growing loads, relaxation; and how a run ends."""
