"""Files for viewers: ParaView."""
