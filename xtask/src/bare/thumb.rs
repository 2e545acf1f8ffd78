//! Calls in ARM's Thumb-2 code.

use std::ops::Range;

/// Offsets of the instructions `BL` (branch with link) in `code`, leaving out regions of data.
pub fn calls(code: &[u8], data: &[Range<u64>]) -> Vec<u64> {
    let halfword = |at: usize| Some(u16::from_le_bytes([*code.get(at)?, *code.get(at + 1)?]));
    let mut calls = Vec::new();
    let mut at = 0;
    while let Some(first) = halfword(at) {
        if data.iter().any(|region| region.contains(&(at as u64))) {
            at += 2;
            continue;
        }
        // 0b11101, 0b11110 and 0b11111 begin an instruction of four bytes, everything else is one of two.
        if first < 0xe800 {
            at += 2;
            continue;
        }
        if first & 0xf800 == 0xf000 && halfword(at + 2).is_some_and(|second| second & 0xd000 == 0xd000) {
            calls.push(at as u64);
        }
        at += 4;
    }
    calls
}
