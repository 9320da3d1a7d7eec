"""The systems of the problem set and further classics, each with its numbers."""

from polhode.catalogue._cases import RunCase as RunCase
from polhode.catalogue._cases import case_of as case_of
from polhode.catalogue._cases import cases_of as cases_of
from polhode.catalogue._entry import CatalogueEntry as CatalogueEntry
from polhode.catalogue._entry import Parameter as Parameter
from polhode.catalogue._entry import about_with as about_with
from polhode.catalogue._entry import contact_numbers as contact_numbers
from polhode.catalogue._named import entry_named_in as entry_named_in
from polhode.catalogue._numbers import RunNumbers as RunNumbers
from polhode.catalogue._numbers import exact_values as exact_values
from polhode.catalogue._numbers import numbers_of as numbers_of
from polhode.catalogue._problem_set import problem_set as problem_set
from polhode.catalogue._systems import CATALOGUE as CATALOGUE
from polhode.catalogue._systems import CLASSICS as CLASSICS
from polhode.catalogue._systems import PROBLEM_SET as PROBLEM_SET
