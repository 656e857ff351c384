//! Descriptions as text: `name=value` and spaces between them.

use std::str::FromStr;

pub(super) fn words(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split_whitespace()
        .filter_map(|word| word.split_once('='))
}

/// Numbers with commas between them.
pub(super) fn comma<T: std::fmt::Display>(numbers: &[T]) -> String {
    let numbers: Vec<String> = numbers.iter().map(T::to_string).collect();
    numbers.join(",")
}

/// As many numbers as wanted.
pub(super) fn tuple<T: FromStr + Copy + Default, const N: usize>(text: &str) -> Option<[T; N]> {
    let mut numbers = text.split(',').map(|part| part.parse::<T>().ok());
    let mut all = [T::default(); N];
    for number in &mut all {
        *number = numbers.next()??;
    }
    numbers.next().is_none().then_some(all)
}

/// Groups of numbers with semicolons between them; none in an empty text.
pub(super) fn tuples<T: FromStr + Copy + Default, const N: usize>(
    text: &str,
) -> Option<Vec<[T; N]>> {
    if text.is_empty() {
        return Some(Vec::new());
    }
    text.split(';').map(tuple).collect()
}

/// The same as text.
pub(super) fn semicolon<T: std::fmt::Display, const N: usize>(groups: &[[T; N]]) -> String {
    let groups: Vec<String> = groups.iter().map(|group| comma(group)).collect();
    groups.join(";")
}
