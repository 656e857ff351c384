//! Whether the rows of the C interface fit the functions of scripts that they name: order, types and lengths of parameters and results.

use std::collections::BTreeMap;

use c_interface::{Interface, Param, Size, Symbol, interface_41, plugin_interface};

use crate::row::FunctionDoc;

/// What a value of C is for scripts.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Integer,
    Bool,
    Number,
    Text,
    Address,
    Integers(Option<usize>),
    Numbers(Option<usize>),
}

fn kind(param: Param) -> Kind {
    let count = match param.size {
        Size::Fixed(count) => Some(count),
        Size::One | Size::Counted => None,
    };
    match (param.ty, param.size) {
        ('S' | 's' | 't' | 'w', _) => Kind::Text,
        ('I' | 'L', _) => Kind::Integers(None),
        ('D' | 'F', _) => Kind::Numbers(None),
        ('p' | 'c', _) => Kind::Address,
        ('b' | 'B', _) => Kind::Bool,
        ('i' | 'l', Size::One) => Kind::Integer,
        ('d' | 'f', Size::One) => Kind::Number,
        ('u', Size::One) => Kind::Integer,
        ('u', _) => Kind::Text,
        ('i' | 'l', _) => Kind::Integers(count),
        _ => Kind::Numbers(count),
    }
}

/// Whether a type of the reference, such as `float[3]`, takes it.
fn fits(kind: Kind, ty: &str) -> bool {
    let ty = ty.trim_end_matches("...");
    if ty == "any" || ty == "table" || kind == Kind::Address {
        return true;
    }
    ty.split('/').any(|ty| {
        let (item, length) = ty
            .split_once('[')
            .map_or((ty, None), |(item, length)| (item, Some(length)));
        let Some(length) = length else {
            return match kind {
                Kind::Integer => matches!(item, "int" | "float" | "handle"),
                Kind::Bool => item == "bool",
                Kind::Number => item == "float",
                Kind::Text => matches!(item, "string" | "buffer"),
                _ => false,
            };
        };
        let has_length = |count: Option<usize>| {
            let wanted = length.trim_end_matches(']').parse().ok();
            wanted.is_none() || count.is_none() || wanted == count
        };
        match kind {
            Kind::Integers(count) => matches!(item, "int" | "float") && has_length(count),
            Kind::Numbers(count) => item == "float" && has_length(count),
            _ => false,
        }
    })
}

/// What the function gets: the parameters that it reads, in its order.
fn arguments(row: &Symbol) -> Vec<Kind> {
    let read = row.params.iter().filter_map(|param| {
        let is_count = !param.is_in && param.size == Size::Counted;
        let kind = if is_count {
            Kind::Integer
        } else {
            kind(*param)
        };
        (param.is_in || is_count).then_some(kind)
    });
    let read: Vec<Kind> = read.collect();
    match &row.order {
        Some(order) => order.iter().map(|&place| read[place]).collect(),
        None => read,
    }
}

/// What the caller gets of the results, in their order.
fn results(row: &Symbol) -> Vec<Kind> {
    let returned = match row.result {
        'v' | 'k' | 'q' => None,
        'd' | 'f' => Some(Kind::Number),
        'S' | 'P' => Some(Kind::Text),
        'I' => Some(Kind::Integers(None)),
        'D' | 'F' | 'V' | 'W' => Some(Kind::Numbers(None)),
        _ => Some(Kind::Integer),
    };
    let written = row
        .params
        .iter()
        .filter(|param| param.is_out && !matches!(param.ty, 'p' | '#'));
    returned
        .into_iter()
        .chain(written.map(|param| kind(*param)))
        .collect()
}

/// What is wrong with a row.
fn mistakes(row: &Symbol, function: &FunctionDoc) -> Vec<String> {
    let mut found = Vec::new();
    let given = arguments(row);
    let takes_more = function
        .parameters
        .last()
        .is_some_and(|last| last.name == "...");
    if given.len() > function.parameters.len() && !takes_more {
        found.push(format!("{} parameters are too many", given.len()));
    }
    for (place, parameter) in function.parameters.iter().enumerate() {
        // Position and frame may come in either order: both have the type of the position.
        let is_frame = parameter.default.as_deref() == Some("sim.handle_world");
        match given.get(place) {
            Some(Kind::Integer) if is_frame => {}
            Some(kind) if !fits(*kind, &parameter.ty) => {
                found.push(format!("{kind:?} for {} {}", parameter.ty, parameter.name));
            }
            None if parameter.default.is_none() && parameter.name != "..." => {
                found.push(format!("{} is not given", parameter.name));
            }
            _ => {}
        }
    }
    let wanted = results(row);
    for (kind, result) in wanted.iter().zip(&function.results) {
        // C's integers take truth values as well.
        let is_truth = *kind == Kind::Integer && result.ty == "bool";
        if !fits(*kind, &result.ty) && !is_truth {
            found.push(format!("{kind:?} of {} {}", result.ty, result.name));
        }
    }
    found
}

/// The rows that name a function of scripts, and that function.
fn check(interface: &Interface, functions: &BTreeMap<String, FunctionDoc>) -> Vec<String> {
    // Of inner functions there is no documentation.
    let is_inner = |name: &str| name.starts_with("swanilda.") || name.contains("._");
    let rows = interface
        .symbols()
        .filter(|row| row.is_of_scripts() && !is_inner(row.function));
    rows.flat_map(|row| match functions.get(row.function) {
        Some(function) => mistakes(row, function)
            .into_iter()
            .map(|mistake| format!("{} ({}): {mistake}", row.symbol, row.function))
            .collect(),
        None => vec![format!("{}: there is no {}", row.symbol, row.function)],
    })
    .collect()
}

#[test]
fn rows_of_both_interfaces_fit_the_functions_that_they_name() {
    let functions: BTreeMap<_, _> = crate::functions()
        .into_iter()
        .map(|function| (function.name.clone(), function))
        .collect();
    let wrong = [
        check(plugin_interface(), &functions),
        check(&interface_41(&[]), &functions),
    ]
    .concat();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The page for programs says how many functions of 4.1 there are, and names those that are missing.
#[test]
fn the_page_for_programs_names_what_is_missing() {
    let page = include_str!("../../../../docs/PYREP.md");
    let interface = interface_41(&[]);
    let (missing, here): (Vec<_>, Vec<_>) = interface.symbols().partition(|row| row.is_missing());
    let all = missing.len() + here.len();
    let count = format!("Of the {all} functions {} work.", here.len());
    assert!(page.contains(&count), "the page does not say: {count}");
    let is_named = |symbol: &str| page.contains(&format!("`{symbol}`"));
    let inner = missing.iter().filter(|row| row.symbol.starts_with("_sim"));
    let inner = format!("({})", inner.count());
    assert!(page.contains(&inner), "{inner} inner functions are missing");
    let unnamed: Vec<_> = missing
        .iter()
        .map(|row| row.symbol)
        .filter(|symbol| !symbol.starts_with("_sim") && !is_named(symbol))
        .collect();
    assert_eq!(unnamed, [""; 0], "these are missing and not named");
}
