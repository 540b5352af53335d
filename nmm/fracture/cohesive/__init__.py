"""Growing cohesive zones: bonded faces inserted ahead of tips and where zones nucleate.

The tractions of open faces are contact laws.
"""
