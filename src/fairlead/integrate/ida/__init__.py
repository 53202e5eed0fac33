"""The engine `ida`: steps by SUNDIALS IDA, all the rest as in `rodas`, whose loop it enters for no step of its own."""
