"""The factor of safety: strengths are divided until nothing holds."""
