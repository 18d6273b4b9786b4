"""Variables of datasets: dimensions, unit, meaning, and when they are there, declared once.

Every kind of dataset has one table of its variables. A dataset is made from values by name through
its table, which refuses a name that it lacks; `docs/results.md` and `docs/study-results.md` are
written from the tables.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

#: When a variable is there that every dataset of its kind has.
ALWAYS = "always"


def described(units: str, long_name: str) -> dict[str, str]:
    """Attributes of a variable or coordinate.

    Parameters
    ----------
    units : str
    long_name : str
        Meaning in words.
    """
    return {"units": units, "long_name": long_name}


class Variable(NamedTuple):
    """A variable of a dataset."""

    name: str
    dims: tuple[str, ...]
    units: str
    when: str  #: When it is there
    long_name: str

    @property
    def attributes(self) -> dict[str, str]:
        """Unit and meaning, as attributes of an array."""
        return described(self.units, self.long_name)

    def of(self, values: Any) -> tuple[tuple[str, ...], Any, dict[str, str]]:
        """Dimensions, values and attributes, as xarray takes them.

        Parameters
        ----------
        values : array_like
            Over the dimensions of the variable.
        """
        return self.dims, values, self.attributes


class VariableTable(Mapping[str, Variable]):
    """All variables of one kind of dataset, by name and in their order.

    Parameters
    ----------
    title : str
        What the datasets are, and the function that makes them.
    variables : iterable of Variable
        Each name once.

    Raises
    ------
    ValueError
        If a name stands twice.

    Examples
    --------
    >>> table = VariableTable("Example", [Variable("load", ("row",), "N", ALWAYS, "largest load")])
    >>> table.put({"load": [1.0, 2.0]})
    {'load': (('row',), [1.0, 2.0], {'units': 'N', 'long_name': 'largest load'})}
    """

    def __init__(self, title: str, variables: Iterable[Variable]):
        self.title = title
        self._variables: dict[str, Variable] = {}
        for variable in variables:
            if variable.name in self._variables:
                raise ValueError(f"{title}: the variable {variable.name} stands twice")
            self._variables[variable.name] = variable

    def __getitem__(self, name: str) -> Variable:
        """The variable of a name."""
        return self._variables[name]

    def __iter__(self) -> Iterator[str]:
        """Names in their order."""
        return iter(self._variables)

    def __len__(self) -> int:
        """Number of variables."""
        return len(self._variables)

    def put(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Values by name as xarray takes them, in the order of the table.

        Parameters
        ----------
        values : mapping
            Arrays over the dimensions of their variables; not every variable is needed.

        Returns
        -------
        dict
            Dimensions, values and attributes by name.

        Raises
        ------
        KeyError
            For a name that the table does not have.
        """
        unknown = set(values) - set(self._variables)
        if unknown:
            listed = ", ".join(sorted(unknown))
            raise KeyError(f"the table of variables has no {listed}")
        return {
            name: variable.of(values[name])
            for name, variable in self._variables.items()
            if name in values
        }
