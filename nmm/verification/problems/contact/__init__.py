"""Blocks that rest, slide, topple, bounce and arch; joints; enforcements. No water, no shaking."""
