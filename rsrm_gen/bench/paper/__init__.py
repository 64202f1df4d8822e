"""`rsrm bench paper`: the experiments of the RSRM paper made again, its own figures beside ours.

published.yaml   what the paper reports, and the networks that it compares with
published.py     that file as data
network.py       an MLP in the place of the splats, with its gradient in the point
descent.py       the training of such a network, as an objective that the trainer's loop drives
methods.py       the recipe, the networks, our default: settings of the same scenes
jobs.py          every training to be made, and which of them are finished
judge.py         a finished training as a row of figures
rows.py          rows kept as JSON; mean and deviation over the seeds
tables.py        the tables of the rows
euclidean.py     splats in the plane, where curvature plays no part, on a published regression case
"""
