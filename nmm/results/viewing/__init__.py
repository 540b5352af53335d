"""Files for viewers: ParaView. Pictures are in `plots`."""
