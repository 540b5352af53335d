"""The stages of a scene: what of it is there and acts in each, and where each begins. No run."""
