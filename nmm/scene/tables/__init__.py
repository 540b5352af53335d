"""Tables of a scene that single effects read, a file for each subject.

Tables that all scenes have are in `scene`.
"""
