"""Pictures and movies of a scene, drawn without a browser."""

from polhode.view.stills._files import movie as movie
from polhode.view.stills._files import still as still
from polhode.view.stills._picture import clearest_time as clearest_time
from polhode.view.stills._picture import picture as picture
