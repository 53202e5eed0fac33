"""The engine `ida`: steps by SUNDIALS IDA, all the rest as in `rodas`."""
