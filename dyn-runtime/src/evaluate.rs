//! The second half of every checked call: a generated function on inputs that have been checked.

/// Calls a generated function of the model and returns its outputs as the caller's types, or
/// [`Error::NonFiniteResult`](crate::Error::NonFiniteResult) if an element of them is not finite.
///
/// ```text
/// evaluate!(self.model.function(inputs) -> Struct { fields })    Result<Struct, Error>
/// evaluate!(self.model.function(inputs) -> output)               Result<_, Error>
/// ```
///
/// Inputs and fields stand in the order in which the trait in [`kernels`](crate::kernels) has inputs and
/// outputs; arrays get their shape from there, and [`FromRows`](crate::arrays::FromRows) turns them into the
/// fields' types.
macro_rules! evaluate {
    ($self:ident.model.$function:ident($($input:expr),+ $(,)?) -> $result:ident { $($field:ident),+ $(,)? }) => {{
        $(let mut $field = Default::default();)+
        $self.model.$function($(&$input,)+ $(&mut $field),+);
        $crate::check::finite_result($($crate::arrays::AllFinite::all_finite(&$field))&+)?;
        Ok($result { $($field: $crate::arrays::FromRows::from_rows(&$field)),+ })
    }};
    ($self:ident.model.$function:ident($($input:expr),+ $(,)?) -> $output:ident) => {{
        let mut $output = Default::default();
        $self.model.$function($(&$input,)+ &mut $output);
        $crate::check::finite_result($crate::arrays::AllFinite::all_finite(&$output))?;
        Ok($crate::arrays::FromRows::from_rows(&$output))
    }};
}

pub(crate) use evaluate;
