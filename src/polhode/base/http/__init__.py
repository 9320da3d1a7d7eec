"""What local servers share: strict JSON, bodies within limits, a socket to listen at.

It needs no package beyond the standard library; messages are those of ASGI.
"""

from polhode.base.http._bodies import Receive as Receive
from polhode.base.http._bodies import raw_headers as raw_headers
from polhode.base.http._bodies import replayed as replayed
from polhode.base.http._bodies import whole_body as whole_body
from polhode.base.http._json_object import json_object as json_object
from polhode.base.http._listening import listening_socket as listening_socket
