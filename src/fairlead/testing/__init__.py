"""The contract that every component keeps, for tests of the library and of components of your own.

from fairlead.testing import checks, contract

contract(MySpring)                                     # all properties; raises ContractError

@pytest.mark.parametrize("check", checks(MySpring), ids=str)
def test_my_spring(check):                             # one test a property
    check()
"""

from fairlead.testing.contract import Check, checks, contract
from fairlead.testing.world import ContractError, ContractRemark

__all__ = ["Check", "ContractError", "ContractRemark", "checks", "contract"]
