"""Independent answers for tests: brute-force rigid-body mechanics in maximal coordinates.

Nothing here imports the package under test. Every body has its own position, rotation, velocity
and angular velocity in one inertial frame; constraints are rows on those, and one linear system
gives all accelerations and multipliers. The systems are written in the text's variables:

- `disks`: spinning coin, rolling disk
- `balls`: marble on a turntable (tilted, level), ball on paper (rolling, sliding)
- `gyroscopes`: gyrocompass, free body, gyroscope (free, held, in a vertical plane)
- `linkages`: double pendulum, four-bar linkage
- `extras`: two wheels on an axle, gyroscope in gimbals, rolling ellipsoid

Each is a function of numbers, by keyword, returning a dict: rates of the speeds (`theta_ddot`,
`omega_3_dot`), reactions (`F_z`, force of the support on the body), `T_dot` and `V_dot`. SI units.
"""
