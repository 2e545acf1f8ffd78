//! One lane, for any processor. More of them, without instructions for it, only fill the registers: four took 1.6 times as
//! long per state as one.

use super::Lanes;

macro_rules! single {
    ($number:ident, $bits:ident) => {
        impl Lanes for $number {
            type Number = Self;
            type Mask = bool;
            const COUNT: usize = 1;

            #[inline(always)]
            fn from_fn(mut number: impl FnMut(usize) -> Self) -> Self {
                number(0)
            }

            #[inline(always)]
            fn splat(number: Self) -> Self {
                number
            }

            #[inline(always)]
            fn load(numbers: &[Self]) -> Self {
                numbers.first().copied().unwrap_or(0.0)
            }

            #[inline(always)]
            fn store(self, numbers: &mut [Self]) {
                if let Some(first) = numbers.first_mut() {
                    *first = self;
                }
            }

            #[inline(always)]
            fn for_each(self, mut use_number: impl FnMut(usize, Self)) {
                use_number(0, self);
            }

            #[inline(always)]
            fn absolute(self) -> Self {
                self.abs()
            }

            #[inline(always)]
            fn less_than(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn select(mask: bool, chosen: Self, other: Self) -> Self {
                if mask { chosen } else { other }
            }

            #[inline(always)]
            fn bits(mask: bool) -> u32 {
                mask.into()
            }

            #[inline(always)]
            fn turned(sine: Self, cosine: Self, quarter_turns: Self, angle: Self) -> (Self, Self) {
                const SIGN: $bits = 1 << ($bits::BITS - 1);
                let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
                let quarter_turns = quarter_turns.to_bits();
                let exchange = (sine ^ cosine) & (quarter_turns & 1).wrapping_neg();
                let sine_sign = ((quarter_turns << ($bits::BITS - 2)) ^ angle.to_bits()) & SIGN;
                let cosine_sign = (quarter_turns.wrapping_add(1) << ($bits::BITS - 2)) & SIGN;
                (
                    Self::from_bits(sine ^ exchange ^ sine_sign),
                    Self::from_bits(cosine ^ exchange ^ cosine_sign),
                )
            }
        }
    };
}
single!(f64, u64);
single!(f32, u32);
