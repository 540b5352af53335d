"""Problems of finite strain: strips that bend by any angle, rubber, squares that spin."""
