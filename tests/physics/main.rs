//! Laws of mechanics that the generated code must obey, whatever it was derived from: nothing here looks at the reference.
//!
//! Every law is asked of the model with run-time parameters on all eleven platforms and of the baked models, in seeded large
//! states, unless it says otherwise. `cargo test -p dyn-tests --test physics -- --nocapture` prints how well each holds.

mod conservation;
mod equation;
mod inertia;
mod kinematics;
mod law;
mod motion;
mod statics;
mod subject;
mod symmetry;
