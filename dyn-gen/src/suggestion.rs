//! The name that was probably meant.

/// The nearest of `known` to a mistyped `name`, if one is near enough to be meant: at most a third of it differs.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let distance = |other: &str| strsim::damerau_levenshtein(&name.to_lowercase(), &other.to_lowercase());
    let limit = (name.chars().count() / 3).max(1);
    let candidates = known.into_iter().map(|other| (distance(other), other));
    candidates.filter(|(distance, _)| *distance <= limit).min().map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn only_what_is_near_is_suggested() {
        let known = ["inverse_dynamics", "forward_dynamics", "bias"];
        assert_eq!(nearest("invers_dynamic", known), Some("inverse_dynamics"));
        assert_eq!(nearest("baas", known), Some("bias"));
        assert_eq!(nearest("Bias", known), Some("bias"));
        assert_eq!(nearest("stiffness", known), None);
    }
}
