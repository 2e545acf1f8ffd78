"""Virtual prototype: the platform's mechanism, body by body, in the multibody program Exudyn.

    exchange    the JSON files, checked
    guide       the base's motion in Exudyn's coordinates
    mechanism   bodies, joints, springs, loads
    equations   Exudyn's residuals and matrices at a state
    start       closure, consistent velocities and accelerations
    simulation  time integration
    run         input to output
"""
