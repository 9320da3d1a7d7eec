"""What local servers share: strict JSON, requests within limits, a socket to listen at.

It needs no package beyond the standard library; messages are those of ASGI.
"""

from polhode.base.http._bodies import Message as Message
from polhode.base.http._bodies import Receive as Receive
from polhode.base.http._bodies import raw_headers as raw_headers
from polhode.base.http._json_object import json_object as json_object
from polhode.base.http._limited_requests import Application as Application
from polhode.base.http._limited_requests import LimitedRequests as LimitedRequests
from polhode.base.http._limited_requests import Scope as Scope
from polhode.base.http._limited_requests import Send as Send
from polhode.base.http._listening import listening_socket as listening_socket
