"""Rolling resistance of lubricated contacts, and contacts that carry little load.

One law a file: Martin's rigid, isoviscous line; Biboulet and Houpert's elastic one and their starvation factor; Goksem
and Hargreaves' inlet of an elastohydrodynamic contact; a fit of full solutions of the whole film. `gap` is a rigid
contact of finite length from a table of solutions of Reynolds' equation. `rolling_law` chooses among them by name, and
`resistance` gives the forces of one contact.
"""
