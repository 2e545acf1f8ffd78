//! Each pass on small fixtures, before and after.

mod common;

use common::text::{parse, print};
use common::{pass, run};
use dyn_gen::graph::{Environment, Node};
use dyn_gen::passes::Context;
use expect_test::{Expect, expect};

fn check(name: &str, before: &str, after: Expect) {
    let parameters = Environment::from([("p".to_owned(), vec![3.0])]);
    let graph =
        run(pass(name), &parse(before), &Context { parameters, states: Vec::new(), ..Context::default() });
    after.assert_eq(&print(&graph));
}

#[test]
fn bake_replaces_parameters_and_folds() {
    check(
        "bake",
        "y = p * 2 + x\nz = pq * p",
        expect![[r#"
        y = 6 + x
        z = 3 * pq
    "#]],
    );
    check(
        "bake",
        "y = 1 / (p - 3)",
        expect![[r#"
        y = 1 / 0
    "#]],
    );
}

#[test]
fn what_cancels_up_to_rounding_is_baked_as_zero() {
    // 3 * 0.1 is 5.6e-17 more than 0.3. Small numbers that do not cancel stay, however small.
    check(
        "bake",
        "a = x * (p * 0.1 - 0.3)\nb = y * (p * 0.1 + (0 - 0.3))\nc = z * ((0 - 0.3) - (0 - p * 0.1))\n\
         d = x * (p / 10 - 0.29999)\ne = x * (p * 0.00000000000000000001 - 0.00000000000000000001)",
        expect![[r#"
            a = x * 0
            b = 0 * y
            c = 0 * z
            d = x * 0.000010000000000010001
            e = x * 0.000000000000000000019999999999999996
        "#]],
    );
}

#[test]
fn chain_begins_sums_of_products_with_the_odd_term() {
    // The sum of products is read once, so it may begin with z; where z comes late, or the sum is read twice, it stays.
    check(
        "chain",
        "a = z + (x * y + u * v)\nb = z - (x * u - y * v)\nc = (x * v + y * y) - z",
        expect![[r#"
            a = (u * v) + (z + (x * y))
            b = (y * v) + (z - (x * u))
            c = (y * y) + ((x * v) - z)
        "#]],
    );
    check(
        "chain",
        "a = sqrt(sqrt(z)) + (x * y + u * v)",
        expect![[r#"
            a = sqrt(sqrt(z)) + ((x * y) + (u * v))
        "#]],
    );
    // A quotient comes late too.
    check(
        "chain",
        "a = 1 / z + (x * y + u * v)",
        expect![[r#"
            a = (1 / z) + ((x * y) + (u * v))
        "#]],
    );
    // A product in front would leave one that no sum takes up, as before.
    check(
        "chain",
        "a = x * y + (u * v + x * v)",
        expect![[r#"
            a = (x * y) + ((u * v) + (x * v))
        "#]],
    );
    // Of two products the one known first is begun with.
    check(
        "chain",
        "a = (sqrt(x) * y + u * v) + z",
        expect![[r#"
            a = (sqrt(x) * y) + ((u * v) + z)
        "#]],
    );
    // There is no sum that begins with two negative terms.
    check(
        "chain",
        "a = (sqrt(x) * y - u * v) - z",
        expect![[r#"
            a = ((sqrt(x) * y) - (u * v)) - z
        "#]],
    );
    check(
        "chain",
        "s = x * y + u * v\na = z + s",
        expect![[r#"
            s = (x * y) + (u * v)
            a = z + s
        "#]],
    );
}

#[test]
fn fuse_takes_up_products_in_sums() {
    // `x * y` has two readers, both sums: it disappears. `u * v` stays for the root, and is taken up where nothing else is.
    let before =
        "a = x * y + z\nb = z - x * y\nc = u * v - z\nd = sqrt(u * v)\ne = u * v + x * z\nf = x * z + x * z";
    check(
        "fuse",
        before,
        expect![[r#"
            t11 = x * z
            a = mul_add(x, y, z)
            b = neg_mul_add(x, y, z)
            c = mul_sub(u, v, z)
            d = sqrt(u * v)
            e = mul_add(u, v, t11)
            f = t11 + t11
        "#]],
    );
}

#[test]
fn simplify_removes_trivial_operands() {
    let before = "a = x * 1 + 0\nb = x * 0\nc = x - x\nd = 0 - x\ne = x / 1\nf = --x\ng = x + x\nh = x / 4\ni = x / -1\nj = 0 / x\n\
                  k = x / 3\nl = (x - 0) * (3 - 2)\nm = x / 0";
    check(
        "simplify",
        before,
        expect![[r#"
        t3 = -x
        a = x
        b = 0
        c = 0
        d = t3
        e = x
        f = x
        g = x * 2
        h = x * 0.25
        i = t3
        j = 0
        k = x / 3
        l = x
        m = x / 0
    "#]],
    );
}

#[test]
fn simplify_moves_signs_outwards() {
    check(
        "simplify",
        "a = x + (-y)\nb = (-x) * y + z\nc = x - (-2) * y\nd = (-x) - y\ne = (-x) / (-y)\nf = sqrt(-(x * -y))",
        expect![[r#"
        t5 = x * y
        a = x - y
        b = z - t5
        c = x + (y * 2)
        d = -(x + y)
        e = x / y
        f = sqrt(t5)
    "#]],
    );
}

#[test]
fn opposite_differences_are_one_node() {
    check(
        "invert",
        "a = (x - y) * z\nb = z + (y - x)\nc = (y - x) * (x - y)",
        expect![[r#"
        t3 = x - y
        a = t3 * z
        b = -(t3 - z)
        c = -(t3 * t3)
    "#]],
    );
}

#[test]
fn invert_divides_once_by_each_divisor() {
    check(
        "invert",
        "a = x / z\nb = y / z\nc = x / y\nd = x / 5",
        expect![[r#"
        t3 = 1 / z
        a = x * t3
        b = t3 * y
        c = x / y
        d = x * 0.2
    "#]],
    );
}

#[test]
fn merge_forms_common_sums_once() {
    check(
        "merge",
        "a = 3 * x + 3 * y",
        expect![[r#"
        a = 3 * (x + y)
    "#]],
    );
    check(
        "merge",
        "a = x + y + z\nb = w - x - y",
        expect![[r#"
        t5 = x + y
        a = z + t5
        b = -(t5 - w)
    "#]],
    );
    check(
        "merge",
        "a = (2 * x) * 3 + 0.5 * y\nb = z - 6 * x - 0.5 * y",
        expect![[r#"
        t9 = (x * 6) + (0.5 * y)
        a = t9
        b = -(t9 - z)
    "#]],
    );
    check(
        "merge",
        "a = x + y - (x - 2 * y)",
        expect![[r#"
        a = y * 3
    "#]],
    );
}

#[test]
fn settle_lets_differences_and_constants_take_signs() {
    check(
        "settle",
        "a = -(x - y)\nb = -(2 * z)\nc = -((x - w) * (z + 1))\nd = -(x * y)\ne = -((3 + w) / z)",
        expect![[r#"
        a = y - x
        b = z * -2
        c = (z + 1) * (w - x)
        d = -(x * y)
        e = (-3 - w) / z
    "#]],
    );
    // A difference with another use stays as it is.
    check(
        "settle",
        "a = -(x - y)\nb = (x - y) * z",
        expect![[r#"
        t2 = x - y
        a = -t2
        b = t2 * z
    "#]],
    );
}

#[test]
fn prune_drops_what_no_output_needs() {
    let mut graph = parse("a = x + p\nb = y * pz");
    graph.outputs.remove(0);
    let pruned = run(pass("prune"), &graph, &Context::default());
    assert_eq!(print(&pruned), "b = y * pz\n");
    let inputs = pruned.inputs.iter().map(|symbol| symbol.name.as_str()).collect::<Vec<_>>();
    // The unused state `x` stays in the signature, the unused parameter `p` goes.
    assert_eq!(inputs, ["x", "y", "pz"]);
    assert_eq!(pruned.nodes.len(), 3);
}

#[test]
fn expand_writes_a_symmetric_system_out() {
    let mut graph = parse("a = x\nb = y\nc = z\nd = v\ne = w");
    let nodes = graph.outputs.iter().map(|output| output.nodes[0]).collect::<Vec<_>>();
    graph.solves.push(dyn_gen::graph::Solve {
        name: "s".to_owned(),
        kind: dyn_gen::graph::SolveKind::SymmetricPositiveDefinite,
        matrix: vec![nodes[0], nodes[1], nodes[1], nodes[2]],
        right_hand_side: vec![nodes[3], nodes[4]],
        attempt: vec![],
    });
    graph.nodes.extend([0, 1].map(|element| Node::Solution { solve: 0, element }));
    graph.section_of.extend([0, 0]);
    graph.outputs.truncate(1);
    graph.outputs[0].nodes = vec![dyn_gen::graph::NodeId(5), dyn_gen::graph::NodeId(6)];
    let expanded = run(pass("expand"), &graph, &Context::default());
    expect![[r#"
        t6 = 1 / x
        t7 = y * t6
        t15 = (w - (v * t7)) * (1 / (z - (y * t7)))
        a = (v * t6) - (t7 * t15), t15
    "#]]
    .assert_eq(&print(&expanded));
}
