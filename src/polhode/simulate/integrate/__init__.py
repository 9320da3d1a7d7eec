"""Taylor series, Dormand-Prince and the driver that puts their steps together."""
