"""Tables of a scene that single effects read: one file a subject."""
