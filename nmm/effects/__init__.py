"""Physical effects, one file each; a scene's effect is imported only when the scene names it.

Fields that diffuse, supports and cracks have rooms of their own.
"""
