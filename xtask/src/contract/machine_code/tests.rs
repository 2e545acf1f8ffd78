//! Small functions, as `objdump` prints them.

use super::{Bounds, MachineCode, Unbounded, Worst};

const LISTING: &str = "
0000000000000000 <leaf>:
   0:\tpush   %rbx
   1:\tsub    $0x20,%rsp
   5:\tadd    %rax,%rbx
   8:\tjne    5 <leaf+0x5>
   a:\tret

0000000000000000 <caller>:
   0:\ttest   %rdi,%rdi
   3:\tje     e <caller+0xe>
   5:\tcall   a <caller+0xa>
\t\t\t6: R_X86_64_PLT32\t.text.leaf-0x4
   a:\tnop
   b:\tnop
   c:\tret
   e:\tjmp    13 <caller+0x13>
\t\t\tf: R_X86_64_PLT32\tmemcpy-0x4

0000000000000000 <again>:
   0:\tcall   0 <again>
   5:\tret

0000000000000000 <nested>:
   0:\tnop
   1:\tnop
   2:\tjne    1 <nested+0x1>
   4:\tjne    0 <nested>
   6:\tret

0000000000000000 <for_ever>:
   0:\tnop
   1:\tjmp    0 <for_ever>
";

fn rounds(function: &'static str, rounds: &'static [u64]) -> [Bounds; 1] {
    [Bounds { function, rounds, reason: "" }]
}

#[test]
fn loops_calls_and_frames_add_up() {
    let code = MachineCode::read(LISTING);
    let bounds = rounds("leaf", &[6]);
    // Two pushes of the frame, six rounds of two, the return.
    assert_eq!(code.worst("leaf", &bounds), Ok(Worst { code: 11, stack: 40, instructions: 2 + 12 + 1 }));
    assert_eq!(code.worst("caller", &bounds), Ok(Worst { code: 15, stack: 48, instructions: 3 + 15 + 3 }));
    assert_eq!(code.reached("caller").into_iter().collect::<Vec<_>>(), ["leaf", "memcpy"]);
    assert_eq!(code.footprint("caller", |_| true), Some((15 + 11, 48)));
    assert_eq!(code.footprint("caller", |name| name != "leaf"), Some((15, 0)));
    assert_eq!(code.footprint("again", |_| true), None);
}

#[test]
fn what_calls_itself_has_no_worst_case() {
    let worst = MachineCode::read(LISTING).worst("again", &[]);
    assert_eq!(worst, Err(Unbounded::Recursion("again".into())));
}

#[test]
fn loops_need_a_bound_and_a_way_out() {
    let code = MachineCode::read(LISTING);
    let refused = |function: &str| Err(Unbounded::Loop(function.to_owned()));
    assert_eq!(code.worst("leaf", &[]), refused("leaf"));
    assert_eq!(code.worst("leaf", &rounds("lea", &[6])), refused("leaf"), "only the whole name counts");
    // The caller has none itself.
    assert_eq!(code.worst("caller", &[]), refused("leaf"));
    let twice = |bounds| code.worst("nested", &rounds("nested", bounds)).map(|worst| worst.instructions);
    assert_eq!(twice(&[5, 3]), Ok(5 * (1 + 3 * 2 + 1) + 1));
    assert_eq!(twice(&[3]), Ok(3 * (1 + 3 * 2 + 1) + 1));
    assert_eq!(code.worst("for_ever", &rounds("for_ever", &[6])), refused("for_ever"));
}

/// A function of one instruction, after those given, that leads somewhere by a register or memory.
fn leading(instructions: &str) -> MachineCode {
    MachineCode::read(&format!("\n0000000000000000 <it>:\n{instructions}\n  40:\tret\n"))
}

#[test]
fn calls_through_the_linkers_table_are_named() {
    let named = |instructions: &str| {
        let code = leading(instructions);
        let bounded = code.worst("it", &[]).map(drop);
        (bounded, code.reached("it").into_iter().collect::<Vec<_>>())
    };
    let memset = (Ok(()), vec!["memset".to_owned()]);
    let direct = "   0:\tcall   *0x0(%rip)        # 6 <it+0x6>\n\t\t\t2: R_X86_64_GOTPCRELX\tmemset-0x4";
    assert_eq!(named(direct), memset);
    let load = "   0:\tmov    0x0(%rip),%rbx        # 7 <it+0x7>\n\t\t\t3: R_X86_64_GOTPCREL\tmemset-0x4\n";
    // The second call, after the first one and what does not write the register.
    let twice = "   7:\tcall   *%rbx\n   9:\tmov    %rbx,%rdi\n   c:\tcmp    %eax,%ebx\n   e:\tcall   *%rbx";
    assert_eq!(named(&format!("{load}{twice}")), memset);
    assert_eq!(named(&format!("{load}   7:\tjmp    *%rbx")), memset);
}

#[test]
fn calls_of_anything_have_no_bound() {
    let unknown = |instructions: &str| {
        let worst = leading(instructions).worst("it", &[]);
        matches!(worst, Err(Unbounded::UnknownCallee(function, _)) if function == "it")
    };
    let load = |register: &str, at: u32| {
        let relocation = "R_X86_64_REX_GOTPCRELX\tmemset-0x4";
        format!("   {at}:\tmov    0x0(%rip),%{register}        # 9 <it+0x9>\n\t\t\t3: {relocation}\n")
    };
    assert!(!unknown(&format!("{}   7:\tcall   *%rbx", load("rbx", 0))));
    // What the caller gave, the memory of an object, a register that was written since or that a call does not keep.
    assert!(unknown("   0:\tcall   *%rdi"));
    assert!(unknown("   0:\tjmp    *%rdi"));
    assert!(unknown("   0:\tcall   *0x18(%rax)"));
    assert!(unknown("   0:\tjmp    *0x18(%rax)"));
    assert!(unknown(&format!("{}   7:\tmov    %edi,%ebx\n   9:\tcall   *%rbx", load("rbx", 0))));
    assert!(unknown(&format!("{}   7:\tcall   *%rax\n   9:\tcall   *%rax", load("rax", 0))));
    // One function on one way, another on the other.
    let other = "   9:\tmov    0x0(%rip),%rbx        # 10 <it+0x10>\n\t\t\tc: R_X86_64_GOTPCREL\tmemcpy-0x4";
    let join = format!("   2:\tje     9 <it+0x9>\n{}   7:\tjmp    20 <it+0x20>\n{other}", load("rbx", 3));
    assert!(unknown(&format!("{join}\n  20:\tcall   *%rbx")));
    // On one of two ways.
    let one_way = format!("   0:\tje     8 <it+0x8>\n{}   8:\tcall   *%rbx", load("rbx", 2));
    assert!(unknown(&one_way));
}

#[test]
fn jumps_through_a_table_stay_in_the_function() {
    let table = "   0:\tadd    %rcx,%rax\n   3:\tjmp    *%rax\n   5:\tnop\n   6:\tjmp    40 <it+0x40>";
    assert_eq!(leading(table).worst("it", &[]).map(|worst| worst.instructions), Ok(5));
    // Nothing is left that only a table leads to.
    let elsewhere = "   0:\tje     40 <it+0x40>\n   3:\tadd    %rcx,%rax\n   5:\tjmp    *%rax";
    assert!(leading(elsewhere).worst("it", &[]).is_err());
}
