"""Newton's method on cut springs, modified and semismooth, and both in compiled loops."""
