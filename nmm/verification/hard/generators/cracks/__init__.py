"""Hard cases of lines that cut bodies: next to lines of the net, across each other, wedged open."""
