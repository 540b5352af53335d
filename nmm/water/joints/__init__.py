"""Water in joints: their network, its flow and storage, the pressure on their faces.

Flow through the pores of blocks is one folder up.
"""
