//! The parts of the search that need no compiler.

use super::archive::leb128;
use super::thumb::calls;

#[test]
fn numbers_of_one_and_of_several_bytes() {
    assert_eq!(leb128(&[0]), 0);
    assert_eq!(leb128(&[0x7f, 0xff]), 127);
    assert_eq!(leb128(&[0xe5, 0x8e, 0x26]), 624_485);
}

#[test]
fn thumb_calls_are_found_among_instructions_and_data() {
    // cmp r0, #0; it eq; bxeq lr; push {r7, lr}; mov r7, sp; sub sp, #8; str r0, [sp, #4]; add r0, sp, #4;
    // ldr r0, [sp, #4]; subs r0, #1; bl 0; strb r0, [r7, #-5]; ldrb r0, [r7, #-5]; add sp, #8; pop {r7, pc}
    let code = [
        0x00, 0x28, 0x04, 0xbf, 0x00, 0x20, 0x70, 0x47, 0x80, 0xb5, 0x6f, 0x46, 0x82, 0xb0, 0x01, 0x90, 0x01,
        0xa8, 0x01, 0x98, 0x01, 0x38, 0xff, 0xf7, 0xf3, 0xff, 0x07, 0xf8, 0x05, 0x0c, 0x78, 0x1f, 0x17, 0xf8,
        0x05, 0x0c, 0x02, 0xb0, 0x80, 0xbd,
    ];
    assert_eq!(calls(&code, &[]), [22]);
    assert!(calls(&code, &[20..28]).is_empty());
    // The second half of a longer instruction is no call: ldr.w pc, [r0], then beq.
    assert!(calls(&[0xd0, 0xf8, 0x00, 0xf0, 0x00, 0xd0], &[]).is_empty());
}
