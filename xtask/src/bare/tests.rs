//! The parts of the search that need no compiler.

use super::archive::leb128;

#[test]
fn numbers_of_one_and_of_several_bytes() {
    assert_eq!(leb128(&[0]), 0);
    assert_eq!(leb128(&[0x7f, 0xff]), 127);
    assert_eq!(leb128(&[0xe5, 0x8e, 0x26]), 624_485);
}
