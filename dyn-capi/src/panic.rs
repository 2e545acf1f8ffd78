//! The panic handler of libraries without `std`.
//!
//! Nothing in this library can panic, and `cargo xtask bare` checks it: it follows every relocation from every exported
//! function of the compiled archive, and fails if this handler can be reached.

use core::panic::PanicInfo;

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    // A controller that went on would act on memory in an unknown state; a watchdog notices one that stands still.
    loop {
        core::hint::spin_loop();
    }
}

/// Panics where `index` is too large, and calls itself: the search must find both, else it finds nothing.
#[cfg(feature = "control-case")]
#[unsafe(no_mangle)]
pub extern "C" fn dyn_control_case(index: usize) -> u8 {
    core::hint::black_box(b"panic")[index] + recursion(index)
}

/// Not a loop, because something remains to be done after the call.
#[cfg(feature = "control-case")]
#[inline(never)]
fn recursion(index: usize) -> u8 {
    if index == 0 { 0 } else { core::hint::black_box(recursion(core::hint::black_box(index) - 1)) }
}
