"""The graph file says what CasADi derived, the same each time, and mistakes in the derivation are named."""

import json
from dataclasses import replace
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from derivation import evaluate as evaluation
from derivation import sample
from derivation.__main__ import document, main
from derivation.evaluate import evaluate, evaluate_graph, solve
from derivation.export import DerivationError, build, export_graph, to_text
from derivation.functions import Function, functions
from derivation.legs import LEG_TYPES, uhp
from derivation.stages import Solve, leg_stage, platform_stage
from derivation.symbols import LEG_COUNT, Symbol, symbols_of

from numeric import generator

ALL = {leg_type: {symbol.name: symbol for symbol in symbols_of(leg)} for leg_type, leg in LEG_TYPES.items()}
STAGES = {
    leg_type: {step.name: step for function in functions(leg) for step in function.steps if not isinstance(step, Solve)}
    for leg_type, leg in LEG_TYPES.items()
}
GRAPHS = Path(__file__).parent.parent / "graphs"


def casadi_value(stage, symbols, arguments: list[np.ndarray]) -> dict[str, np.ndarray]:
    """The stage evaluated by CasADi's own virtual machine."""
    values, flat = {}, []
    for name, numbers in zip(stage.arguments, arguments, strict=True):
        symbol = symbols[name]
        rows, columns = (*symbol.shape, 1, 1)[:2]
        count = LEG_COUNT if symbol.per_leg and not stage.over_legs else 1
        matrices = [ca.SX.sym(f"{name}{k}", rows, columns) for k in range(count)]
        values[name] = matrices if count > 1 else matrices[0]
        flat += [(matrix, numbers.reshape(count, rows, columns)[k]) for k, matrix in enumerate(matrices)]
    results = stage.derive(**values)
    function = ca.Function("stage", [matrix for matrix, _ in flat], [ca.densify(ca.SX(r)) for r in results.values()])
    outputs = function.call([number for _, number in flat])
    return {name: np.array(output).flatten() for name, output in zip(results, outputs, strict=True)}


@pytest.mark.parametrize("leg_type, name", [(leg, name) for leg, stages in STAGES.items() for name in sorted(stages)])
def test_exported_nodes_equal_casadi(leg_type, name):
    stage, symbols = STAGES[leg_type][name], ALL[leg_type]
    rng = generator(7)
    sizes = [
        int(np.prod(symbols[a].shape)) * (LEG_COUNT if symbols[a].per_leg and not stage.over_legs else 1)
        for a in stage.arguments
    ]
    # Rods long enough to reach whatever the joints' random places are.
    scale = {"rod_length": 5}
    arguments = [
        rng.uniform(0.1, 0.3, size=size) * scale.get(a, 1) for a, size in zip(stage.arguments, sizes, strict=True)
    ]
    exported = evaluate_graph(export_graph(stage, symbols), [list(map(float, numbers)) for numbers in arguments])
    for output, numbers in casadi_value(stage, symbols, arguments).items():
        np.testing.assert_allclose(exported[output], numbers, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("leg_type", LEG_TYPES)
def test_deriving_again_gives_the_same_bytes(leg_type):
    first = to_text(document(leg_type))
    assert first == to_text(document(leg_type))
    assert first == (GRAPHS / f"{leg_type}.json").read_text(encoding="utf-8"), "run: cargo regen --derive"


def test_every_stage_of_the_table_is_called_by_some_leg_type():
    offered = {name for stages in STAGES.values() for name in stages}
    called = {graph["name"] for leg_type in LEG_TYPES for graph in document(leg_type)["graphs"]}
    assert offered == called


def signatures(leg_type, leg_specific):
    """Inputs and outputs of functions with all that is said about them."""
    data = document(leg_type)
    symbols = {symbol["name"]: symbol for symbol in data["symbols"]}
    rows = [row for row in data["functions"] if row["leg_specific"] == leg_specific]
    return {
        row["name"]: (row["meaning"], row["equation"], [symbols[name] for name in row["inputs"] + row["outputs"]])
        for row in rows
    }


@pytest.mark.parametrize("leg_type", LEG_TYPES)
def test_common_functions_have_one_signature(leg_type):
    assert signatures(leg_type, leg_specific=False) == signatures("uhp", leg_specific=False)


@pytest.mark.parametrize("leg_type", LEG_TYPES)
def test_leg_types_have_the_same_functions(leg_type):
    assert signatures(leg_type, leg_specific=True).keys() == signatures("uhp", leg_specific=True).keys()


def test_no_number_comes_from_the_built_in_sum(monkeypatch):
    """Python 3.12 made it round differently, so files would depend on the interpreter."""
    expected = document("uhp")

    def refuse(*_):
        raise AssertionError("use evaluate.dot")

    monkeypatch.setattr(sample, "sum", refuse, raising=False)
    monkeypatch.setattr(evaluation, "sum", refuse, raising=False)
    assert document("uhp") == expected


def test_file_is_json_with_exact_floats():
    data = document("uhp")
    assert json.loads(to_text(data)) == json.loads(json.dumps(data))


def test_check_reports_and_writes_nothing(tmp_path, monkeypatch, capsys):
    target = tmp_path / "uhp.json"
    target.write_text("old")
    monkeypatch.setattr("sys.argv", ["derivation", "--folder", str(tmp_path), "--check"])
    assert main() == 1
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["uhp.json"]
    assert "is not what the derivation gives" in capsys.readouterr().err


def test_failed_derivation_leaves_the_file(tmp_path, monkeypatch, capsys):
    target = tmp_path / "uhp.json"
    target.write_text("old")
    monkeypatch.setattr("sys.argv", ["derivation", "--folder", str(tmp_path)])
    broken = replace(uhp.length_gradient, derive=lambda **_: {"length_gradient": ca.SX.sym("g", 2)})
    monkeypatch.setattr(uhp, "length_gradient", broken)
    assert main() == 2
    assert [path.name for path in tmp_path.iterdir()] == ["uhp.json"]
    assert target.read_text() == "old"
    assert "stage length_gradient: result length_gradient has shape (2, 1)" in capsys.readouterr().err


def test_an_operation_without_a_name_is_refused():
    @leg_stage
    def turning(rod_length):
        """a sine, which graphs do not have."""
        return {"rod_alignment": ca.sin(rod_length)}

    with pytest.raises(DerivationError, match="stage turning: CasADi operation number"):
        export_graph(turning, ALL["uhp"])


@pytest.mark.parametrize("argument, result, message", [
    ("nonsense", "rod_alignment", "stage odd: argument nonsense is not in the symbol table"),
    ("rod_length", "nonsense", "stage odd: result nonsense is not in the symbol table"),
])
def test_unknown_names_are_refused(argument, result, message):
    odd = replace(uhp.leg_closure, name="odd", arguments=(argument,), derive=lambda **kw: {result: ca.SX(1)})
    with pytest.raises(DerivationError, match=message):
        export_graph(odd, ALL["uhp"])


def test_unused_symbols_are_refused():
    symbol = Symbol("lonely", "intermediate", (), "1", "-", "used by no one")

    @platform_stage
    def weight(payload_mass):
        """something."""
        return {"kinetic_energy": payload_mass}

    symbols = [ALL["uhp"]["payload_mass"], ALL["uhp"]["kinetic_energy"], symbol]
    with pytest.raises(DerivationError, match="symbols that nothing uses: lonely"):
        build("one", symbols, [Function("one", "something", "", ("kinetic_energy",), (weight,))])


@pytest.mark.parametrize("leg_type", LEG_TYPES)
def test_functions_ask_only_for_what_they_need(leg_type):
    rows = {row["name"]: row for row in document(leg_type)["functions"]}
    pose = ["base_position", "base_rotation", "platform_position", "platform_rotation"]
    assert rows["jacobian_dp"]["inputs"] == pose
    assert rows["mass_matrix_p"]["inputs"] == pose
    assert rows["partial_velocities"]["inputs"] == pose
    assert "platform_acceleration" not in rows["forward_dynamics"]["inputs"]
    assert "actuator_force" not in rows["inverse_dynamics"]["inputs"]


def test_solve_pivots():
    assert solve([0.0, 2.0, 1.0, 0.0], [4.0, 3.0]) == [3.0, 2.0]
