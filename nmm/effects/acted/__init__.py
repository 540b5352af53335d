"""Faces and bonds on which a scene lets something act. What acts there is in other rooms."""
