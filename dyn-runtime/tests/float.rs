//! Square roots and arc tangents have the same bits with and without the feature `std`.

use dyn_runtime::float;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// The tests themselves run with std: whichever way the crate was built, its bits are those of the inherent
/// method, and those of libm.
#[test]
fn square_root_is_the_same_everywhere() {
    let mut random = Pcg64::seed_from_u64(1);
    let any_bits = core::iter::repeat_with(|| f64::from_bits(random.random())).take(200_000);
    let edges = [0.0, -0.0, 1.0, 2.0, f64::MIN_POSITIVE, f64::from_bits(1), f64::MAX, f64::INFINITY];
    for x in any_bits.filter(|x| *x >= 0.0).chain(edges) {
        assert_eq!(float::sqrt(x).to_bits(), x.sqrt().to_bits(), "sqrt({x:e})");
        assert_eq!(libm::sqrt(x).to_bits(), x.sqrt().to_bits(), "sqrt({x:e})");
    }
}

#[test]
fn no_square_root_below_zero() {
    for x in [-1.0, -f64::MIN_POSITIVE, f64::NEG_INFINITY, f64::NAN] {
        assert!(float::sqrt(x).is_nan());
    }
}

/// It may not come from the host's C library.
#[test]
fn arc_tangents_are_those_of_libm() {
    let mut random = Pcg64::seed_from_u64(2);
    for _ in 0..20_000 {
        let (y, x) = (random.random_range(-7.0..7.0), random.random_range(-7.0..7.0));
        assert_eq!(float::atan2(y, x), libm::atan2(y, x));
    }
}
