// The answer to a request: a picture of the motion, or a table.

import type { Reply, Request } from "./computer";
import { handled } from "./hand";
import type { LiveData } from "./model";
import type { Ending, Engine, Motion } from "./motion";
import { type Computed, pictured } from "./picture";

export interface Answer {
  end: number;
  ending: Ending;
  computed: Computed | null;
  table: string;
  /** Coefficients of friction at the start and at most, of a motion that needs them to roll throughout. */
  needed?: [number, number] | null;
}

/** The answer, or the reason why there is none. */
export function replyTo(engine: Engine, live: LiveData, request: Request): Reply {
  try {
    const { id, numbers, hand } = request;
    return { id, answer: hand ? handled(engine, live, numbers, hand) : answered(engine, live, request) };
  } catch (error) {
    return { id: request.id, error: (error as Error).message };
  }
}

function answered(engine: Engine, live: LiveData, { numbers, frames, table }: Request): Answer {
  const motion = engine.follow(numbers, frames);
  const { end, ending } = motion;
  if (!end) return { end, ending, computed: null, table: "" };
  if (table) return { end, ending, computed: null, table: tableOf(live, motion) };
  return { end, ending, computed: pictured(live, engine, motion), table: "", needed: motion.needed };
}

/** Time, coordinates, speeds and plotted quantities in SI units, with all digits, as CSV. */
function tableOf(live: LiveData, motion: Motion): string {
  const states = live.start.map(({ name }, i) => ({ name, values: motion.column(live.states[i]) }));
  const plotted = live.drawn.panels.flatMap(({ series }) => series).map(({ name, value }) => ({ name, values: motion.column(value) }));
  const known = new Set(states.map(({ name }) => name));
  const columns = [...states, ...plotted.filter(({ name }) => !known.has(name))];
  const rows = Array.from({ length: motion.frames }, (_, i) => [motion.time(i), ...columns.map(({ values }) => values[i])].join(","));
  return [["t", ...columns.map(({ name }) => name)].join(","), ...rows, ""].join("\n");
}
