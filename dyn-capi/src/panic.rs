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
