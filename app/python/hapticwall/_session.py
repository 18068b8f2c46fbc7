"""A scene that a program drives, tick by tick."""

from __future__ import annotations

from types import TracebackType

from hapticwall import _core
from hapticwall._law import Algorithm, heard, index_of, told
from hapticwall._path import Path
from hapticwall._run import Summary
from hapticwall._scene import Scene, Value, scene_of, setting

Sample = _core.Sample


class Session(_core.Session):
    """A scene on the simulator without a clock: each step() is one tick of the same loop as run().

        with hw.Session("press", algorithm="energy-bounding") as session:
            while session.time_s < 6.0:
                sample = session.step(hand_force_n=controller(session.position_m))

    `tick`, `time_s` and `position_m` (as measured) are those that the next step will have; `diverged`
    is True when there is none. Algorithms cannot be registered before close(), which `with` calls.
    """

    def __init__(self, scene: Scene | Path, algorithm: Algorithm | Path | None = None) -> None:
        core = scene_of(scene)._core
        if algorithm is not None:
            core = core.under(index_of(algorithm))
        with heard() as raised:
            super().__init__(core)
        told(raised, None)
        self._hears = self._has_plugin()

    def _has_plugin(self) -> bool:
        """Whether a function of one's own may raise."""
        return any(index >= _core.first_plugin() for index in self.core_scene.algorithms()) or any(
            _core.own_environment(name) for name in self.core_scene.environments()
        )

    def step(self, hand_force_n: float = 0.0, hand_force_y_n: float = 0.0) -> Sample:
        """One tick, with a force of the hand that is held through it, newtons, positive into the wall.

        It acts on the handle beside the spring of the scene's hand, if there is one. Returns the row of
        this tick on axis x, with the columns of a recording; the next step overwrites it. ValueError
        for a force that is not finite, RuntimeError after a run has diverged, LawError if a law of one's
        own raised an exception.
        """
        if not self._hears:
            return super().step(hand_force_n, hand_force_y_n)
        with heard() as raised:
            try:
                sample = super().step(hand_force_n, hand_force_y_n)
            except RuntimeError:
                told(raised, None)
                raise
        return told(raised, sample)

    @property
    def sample_y(self) -> Sample:
        """The row of the last step on axis y. ValueError without a second axis."""
        return self.newest(1)

    @property
    def position_y_m(self) -> float:
        """The position of axis y that the next step will have. ValueError without a second axis."""
        return self.measured_m(1)

    def set(self, key: str, value: Value) -> None:
        """Changes a value of the scene from the next tick on, as a live session does.

        ValueError for a wrong value, and for rate, jitter, seed, start and path of the hand, which stay.
        """
        with heard() as raised:
            self.change([(key, setting(value))])
        self._hears = self._has_plugin()
        told(raised, None)

    @property
    def scene(self) -> Scene:
        """The scene in force."""
        return Scene(self.core_scene)

    @property
    def summary(self) -> Summary:
        """The summary of the ticks so far, with the keys of `hapticwall run --json`."""
        return self.core_summary()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()
