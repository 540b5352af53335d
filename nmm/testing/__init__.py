"""What parts are held to: oracles and property suites.

Oracles share nothing with what they judge; every kind of exchangeable part has a suite.
"""
