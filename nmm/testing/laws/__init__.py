"""What laws of materials, interfaces and bonds, strengths and criteria of growth are held to."""
