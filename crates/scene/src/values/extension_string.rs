//! Extension strings: nested name-value pairs for renderers, such as `povray {focalBlur {true} aperture {0.1}}`.

/// The value of an entry; `key` names it and what it is in, the innermost first: `aperture@povray`.
pub fn entry<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    key.rsplit('@')
        .try_fold(text, |text, name| value(text, name.trim()))
        .map(str::trim)
}

/// The content of the braces after a name.
fn value<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let end = closing(after)?;
        if before.trim() == name {
            return after.get(..end);
        }
        rest = after.get(end + 1..)?;
    }
    None
}

/// Where the brace that is open ends.
fn closing(text: &str) -> Option<usize> {
    let mut open = 1usize;
    text.char_indices().find_map(|(at, c)| {
        match c {
            '{' => open += 1,
            '}' => open -= 1,
            _ => {}
        }
        (open == 0).then_some(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_found_by_their_names() {
        let text = "povray {pattern {default} aperture { 0.1 }} openGL3 {lightProjection {nearPlane {0.1}}}";
        assert_eq!(entry(text, "aperture@povray"), Some("0.1"));
        assert_eq!(
            entry(text, "nearPlane@lightProjection@openGL3"),
            Some("0.1")
        );
        assert_eq!(
            entry(text, "povray"),
            Some("pattern {default} aperture { 0.1 }")
        );
        assert_eq!(
            (
                entry(text, "nearPlane@openGL3"),
                entry("povray {open", "povray"),
                entry("", "")
            ),
            (None, None, None)
        );
    }
}
