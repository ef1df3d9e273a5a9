"""The kernels of a film of one temperature for graphics cards: those of this folder's parent, a column of a block a job.

`kernels` has their loops around the same functions, `twins` says which stands for which, `bending` makes the film, `newton`
keeps the vectors of a Newton step on the card. Imported only where it is wanted.
"""
