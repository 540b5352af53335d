"""Steps with contact: the search for contacts and its repetition, steps along paths.

Contact itself, as it is in such a step, is in `nmm.contact`.
"""
