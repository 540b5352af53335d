"""Static paths that fall: bars that soften, links and columns that break one by one."""
