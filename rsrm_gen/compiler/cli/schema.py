"""`rsrm-gen schema`: the keys of manifold files as a JSON schema, for editors."""

from __future__ import annotations


def schema_command() -> None:
    """Print the JSON schema of manifold files, for editors.

    Write it to a file and name that in the first line of a manifold file:

    \b
      rsrm-gen schema > manifold.schema.json
      # yaml-language-server: $schema=manifold.schema.json
    """
    import json

    from rsrm_gen.compiler.spec.editors import json_schema

    print(json.dumps(json_schema(), indent=2))
