"""Tables of effects of one's own, whose keys the effect declares."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, ConfigDict, Field

from nmm.scene.fields import PART_NAME, Frozen, plain_data


class EffectTable(Frozen):
    """An effect of one's own; what else stands in the table is read by ``Effect.Table``."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Annotated[Any, BeforeValidator(plain_data)]] = Field(init=False)

    # Names of built-in effects have blanks: they are refused with what calls for them.
    type: str = Field(
        pattern=rf"{PART_NAME}|^[a-z ]+$",
        description='"module:Class" of an effect of one\'s own, or the name of an installed one',
        examples=["foundation:Winkler"],
    )

    @property
    def given(self) -> dict[str, Any]:
        """The keys of the table, its type excepted, as read."""
        return dict(self.__pydantic_extra__)
