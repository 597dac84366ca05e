import pytest
from pydantic import BaseModel, ConfigDict, Field, create_model

from instrument.facts.docstrings import DescribedSchema, docstrings_of


class Inner(BaseModel):
    depth: float
    """How deep."""
    unsaid: int = 0


class Outer(Inner):
    """Of all of them."""

    model_config = ConfigDict(validate_by_name=True)

    inner: Inner
    """What is
    inside."""
    width: float = Field(0.0, alias="w", description="Said otherwise.")
    """Not this."""

    @property
    def area(self) -> float:
        """Of no field."""
        return self.depth * self.width


def test_fields_have_what_stands_below_them_inherited_ones_too():
    assert docstrings_of(Inner) == {"depth": "How deep."}
    assert docstrings_of(Outer) == {"depth": "How deep.", "inner": "What is\ninside.", "width": "Not this."}


def test_a_model_without_a_source_has_none():
    assert docstrings_of(create_model("Made", depth=(float, ...))) == {}


@pytest.mark.parametrize("mode", ["serialization", "validation"])
def test_the_schema_describes_a_model_and_those_in_it(mode):
    schema = Outer.model_json_schema(mode=mode, schema_generator=DescribedSchema)
    said = {key: field.get("description") for key, field in schema["properties"].items()}
    assert said == {"depth": "How deep.", "unsaid": None, "inner": "What is\ninside.", "w": "Said otherwise."}
    assert schema["$defs"]["Inner"]["properties"]["depth"]["description"] == "How deep."
