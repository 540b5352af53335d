"""Thresholds of audits: what each measures, when it warns and fails, of which runs."""
