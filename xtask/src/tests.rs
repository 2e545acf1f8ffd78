//! The table of steps, the count of tests, and the README's two commands.

use std::collections::HashSet;
use std::fs;

use crate::runner::Count;
use crate::steps::{RUN, Step, TEST, select};
use crate::workspace::root;

const RUN_COMMAND: &str = "cargo xtask run";
const TEST_COMMAND: &str = "cargo xtask test";

#[test]
fn readme_has_one_command_under_each_heading() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md at the workspace's root");
    assert_eq!(code_blocks(&readme, "Run"), [RUN_COMMAND]);
    assert_eq!(code_blocks(&readme, "Test"), [TEST_COMMAND]);
}

#[test]
fn ci_runs_the_readmes_test_command() {
    let script = fs::read_to_string(root().join(".ci/run")).unwrap();
    let commands: Vec<_> = script
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#') && !line.starts_with("set "))
        .collect();
    assert_eq!(commands, [r#"cd "$(dirname "${BASH_SOURCE[0]}")/..""#, TEST_COMMAND]);
}

#[test]
fn code_blocks_of_a_heading() {
    let text = "# T\n## Run\ntext\n```sh\na\n```\n### More\n```\nb\nc\n```\n## Test\n```\nd\n```\n";
    assert_eq!(code_blocks(text, "Run"), ["a", "b\nc"]);
    assert_eq!(code_blocks(text, "Test"), ["d"]);
    assert!(code_blocks(text, "None").is_empty());
}

/// Code blocks between the heading and the next one of its level or above.
fn code_blocks(text: &str, heading: &str) -> Vec<String> {
    let level = |line: &str| line.bytes().take_while(|byte| *byte == b'#').count();
    let (mut blocks, mut inside, mut within) = (Vec::new(), None::<Vec<&str>>, None);
    for line in text.lines() {
        if line.starts_with("```") {
            match inside.take() {
                Some(block) if within.is_some() => blocks.push(block.join("\n")),
                Some(_) => {}
                None => inside = Some(Vec::new()),
            }
        } else if let Some(block) = &mut inside {
            block.push(line);
        } else if level(line) > 0 {
            if line.trim_start_matches('#').trim() == heading {
                within = Some(level(line));
            } else if within.is_some_and(|own| level(line) <= own) {
                within = None;
            }
        }
    }
    blocks
}

#[test]
fn names_of_steps_differ() {
    for steps in [RUN, TEST] {
        let names: HashSet<_> = steps.iter().map(|step| step.name).collect();
        assert_eq!(names.len(), steps.len());
    }
}

#[test]
fn selection() {
    let names = |steps: &[Step]| steps.iter().map(|step| step.name).collect::<Vec<_>>();
    assert_eq!(names(select(RUN, None, None).unwrap()), ["generate", "explain", "first-call", "experiment"]);
    assert_eq!(names(select(RUN, Some("first-call"), None).unwrap()), ["first-call", "experiment"]);
    assert_eq!(names(select(RUN, None, Some("explain")).unwrap()), ["explain"]);
    let message = select(RUN, Some("explian"), None).err().unwrap().to_string();
    assert!(message.contains("`explian`") && message.contains("generate, explain"), "{message}");
}

#[test]
fn closing_lines_are_added_up() {
    let mut count = Count::default();
    for line in [
        "running 14 tests",
        "test result: ok. 12 passed; 0 failed; 2 ignored; 0 measured; 0 filtered out; finished in 0.53s",
        "test result: ok. 3 passed; 0 failed; 0 ignored; 0 measured; 7 filtered out; finished in 0.00s",
    ] {
        count.add(line);
    }
    assert_eq!(count, Count { passed: 15, ignored: 2 });
}
