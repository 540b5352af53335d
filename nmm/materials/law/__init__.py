"""What a stress-strain law answers: its responses, and what acts across the plane."""
