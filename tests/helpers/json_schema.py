"""As much of JSON Schema (2020-12) as the published schemas use: whether a value is as one says."""

TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "null": type(None),
    "number": (int, float),
    "integer": int,
}
KNOWN = {
    *("$schema", "$defs", "$ref", "title", "description", "default", "type", "enum", "const", "anyOf"),
    *("properties", "required", "additionalProperties", "items", "prefixItems", "minItems", "maxItems"),
}


def faults(value, schema, whole=None, place="$"):
    """What is not as the schema says, a line each; a keyword not known here is an error."""
    whole = whole or schema
    assert set(schema) <= KNOWN, set(schema) - KNOWN
    if "$ref" in schema:
        name = schema["$ref"].removeprefix("#/$defs/")
        return faults(value, whole["$defs"][name], whole, place)
    if "anyOf" in schema:
        each = [faults(value, one, whole, place) for one in schema["anyOf"]]
        return [] if not all(each) else [f"{place}: {value!r:.40} is none of {len(each)}"]
    if "type" in schema and not _is(value, schema["type"]):
        return [f"{place}: {value!r:.40}, expected {schema['type']}"]
    if value not in schema.get("enum", [value]) or value != schema.get("const", value):
        return [f"{place}: {value!r:.40} is none of those listed"]
    found = []
    if isinstance(value, dict):
        found += [f"{place}.{key}: missing" for key in schema.get("required", ()) if key not in value]
        known, further = schema.get("properties", {}), schema.get("additionalProperties", True)
        for key, item in value.items():
            of_key = known.get(key, further)
            if of_key is False:
                found.append(f"{place}.{key}: unknown")
            elif of_key is not True:
                found += faults(item, of_key, whole, f"{place}.{key}")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{place}: {len(value)} items")
        first = schema.get("prefixItems", [])
        for k, item in enumerate(value):
            of_item = first[k] if k < len(first) else schema.get("items", {})
            found += faults(item, of_item, whole, f"{place}[{k}]")
    return found


def _is(value, name):
    if isinstance(value, bool):
        return name == "boolean"
    return isinstance(value, TYPES[name])
