/** Some mode, impact or slip was expected to be possible, and none is, or several. */
export class NoModeError extends Error {}
