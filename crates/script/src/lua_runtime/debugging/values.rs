//! Values as people see them: texts, and what is in them.

use std::ffi::{CStr, c_int};

use super::{frames, kind_name};
use crate::host::{Container, FrameId, Page, PageKind, Variable};
use crate::lua::{Stack, Type};

/// Registry key of the values that were shown with contents.
const VALUES: &CStr = c"swanilda.debugger.values";
/// Longer texts are cut.
const MAX_TEXT: usize = 1000;
/// Entries of a table in its own line.
const MAX_PREVIEW: usize = 5;
/// Entries of a table that are looked at, and shown at once.
const MAX_ENTRIES: usize = 10_000;
/// The name of a metatable among the contents of its value.
const METATABLE: &str = "(metatable)";

/// The value at `index`; one with contents gets a number.
pub(super) fn describe(stack: Stack<'_>, index: c_int, name: String) -> Variable {
    let index = stack.absolute(index);
    let kind = stack.kind(index);
    let (indexed, named) = sizes(stack, index, kind);
    let has_contents = indexed + named > 0;
    Variable {
        name,
        value: text(stack, index, true),
        kind: kind_name(kind),
        contents: has_contents.then(|| number(stack, index)),
        indexed,
        named,
    }
}

/// How many items, and how many other variables a value has.
fn sizes(stack: Stack<'_>, index: c_int, kind: Type) -> (usize, usize) {
    let metatable = usize::from(
        matches!(kind, Type::Table | Type::UserData) && stack.push_metatable(index) && {
            stack.pop(1);
            true
        },
    );
    match kind {
        Type::Table => {
            let items = stack.raw_len(index);
            (items, fields(stack, index).len() + metatable)
        }
        Type::Function => (0, stack.upvalue_names(index).len()),
        Type::UserData => (0, metatable),
        _ => (0, 0),
    }
}

/// Stores the value at `index` and returns its number.
fn number(stack: Stack<'_>, index: c_int) -> u32 {
    if stack.push_registry(VALUES) != Type::Table {
        stack.pop(1);
        stack.new_table(0, 0);
        stack.push_value(-1);
        stack.set_registry(VALUES);
    }
    let number = stack.raw_len(-1) + 1;
    stack.push_value(index);
    stack.raw_set_index(-2, numbers::count(number));
    stack.pop(1);
    u32::try_from(number).unwrap_or(u32::MAX)
}

pub(super) fn forget(stack: Stack<'_>) {
    stack.push_nil();
    stack.set_registry(VALUES);
}

/// Pushes the value with that number.
fn push(stack: Stack<'_>, number: u32) -> Type {
    if stack.push_registry(VALUES) == Type::Table {
        stack.raw_get_index(-1, i64::from(number));
        stack.remove(-2);
    }
    stack.kind(-1)
}

/// The value at `index` in one line.
fn text(stack: Stack<'_>, index: c_int, with_entries: bool) -> String {
    match stack.kind(index) {
        Type::None | Type::Nil => "nil".into(),
        Type::Boolean => stack.truthy(index).to_string(),
        Type::Number => lossy(stack.text(index)),
        Type::String => quoted(&lossy(stack.text(index))),
        Type::Table if with_entries => preview(stack, index),
        Type::Table => "{…}".into(),
        Type::Function => function(stack, index),
        kind @ (Type::UserData | Type::LightUserData | Type::Thread) => {
            named_type(stack, index).unwrap_or_else(|| kind_name(kind).into())
        }
    }
}

fn lossy(text: Option<Vec<u8>>) -> String {
    String::from_utf8_lossy(&text.unwrap_or_default()).into_owned()
}

fn quoted(text: &str) -> String {
    let cut: String = text.chars().take(MAX_TEXT).collect();
    let end = if cut.len() < text.len() { "…" } else { "" };
    format!("{cut:?}{end}")
}

fn function(stack: Stack<'_>, index: c_int) -> String {
    stack.push_value(index);
    let chunk = stack.chunk_name_of_function();
    stack.pop(1);
    match chunk {
        Some(chunk) => {
            let chunk = lossy(Some(chunk));
            let name = chunk.trim_start_matches(['@', '=']).lines().next();
            format!("function of {}", name.unwrap_or_default())
        }
        None => "function (native)".into(),
    }
}

/// The name that the metatable of userdata has.
fn named_type(stack: Stack<'_>, index: c_int) -> Option<String> {
    if stack.kind(index) != Type::UserData || !stack.push_metatable(index) {
        return None;
    }
    stack.raw_get_field(-1, "__name");
    let name = stack.text(-1).map(|name| lossy(Some(name)));
    stack.pop(2);
    name
}

fn preview(stack: Stack<'_>, table: c_int) -> String {
    let items = stack.raw_len(table);
    let mut parts = Vec::new();
    for i in 1..=items.min(MAX_PREVIEW) {
        stack.raw_get_index(table, numbers::count(i));
        parts.push(text(stack, stack.top(), false));
        stack.pop(1);
    }
    let fields = fields(stack, table);
    for field in fields.iter().take(MAX_PREVIEW - parts.len()) {
        parts.push(format!("{} = {}", field.name, field.text));
    }
    if items + fields.len() > parts.len() {
        parts.push("…".into());
    }
    format!("{{{}}}", parts.join(", "))
}

/// An entry of a table that is no item of its list.
struct Field {
    name: String,
    text: String,
}

/// The other entries of the table at `index`, by name, as far as they are looked at.
fn fields(stack: Stack<'_>, index: c_int) -> Vec<Field> {
    let mut fields = Vec::new();
    each_field(stack, index, |key, value| {
        fields.push(Field {
            name: key_name(stack, key),
            text: text(stack, value, false),
        });
        fields.len() < MAX_ENTRIES
    });
    fields.sort_by(|a, b| a.name.cmp(&b.name));
    fields
}

/// Calls `look` with the indices of key and value of each field, until that is false. The stack is as before in the end.
fn each_field(stack: Stack<'_>, index: c_int, mut look: impl FnMut(c_int, c_int) -> bool) {
    let index = stack.absolute(index);
    let (top, length) = (stack.top(), numbers::count(stack.raw_len(index)));
    let mut entries = stack.entries(index);
    while entries.advance() {
        let is_item = stack
            .integer(entries.key())
            .is_some_and(|key| (1..=length).contains(&key));
        if !is_item && !look(entries.key(), entries.value()) {
            break;
        }
    }
    stack.set_top(top);
}

/// A key as it is written: a name, or in brackets.
fn key_name(stack: Stack<'_>, key: c_int) -> String {
    if stack.kind(key) == Type::String {
        let name = lossy(stack.text(key));
        let is_plain = name.chars().all(|c| c.is_alphanumeric() || c == '_')
            && !name.starts_with(|c: char| c.is_ascii_digit());
        if is_plain && !name.is_empty() {
            return name;
        }
    }
    format!("[{}]", text(stack, key, false))
}

/// The variables of a container. `stack` is where code can run.
pub(super) fn variables(
    stack: Stack<'_>,
    main: Stack<'_>,
    of: Container,
    page: Page,
) -> Vec<Variable> {
    if !stack.reserve(20) {
        return Vec::new();
    }
    match of {
        Container::Locals(frame) => locals(stack, main, frame, page),
        Container::Upvalues(frame) => {
            push_function(stack, main, frame);
            upvalues(stack, page)
        }
        Container::Globals => {
            stack.push_globals();
            contents(stack, page)
        }
        Container::Value(number) => {
            push(stack, number);
            contents(stack, page)
        }
    }
}

/// Pushes the function of a frame, or nil.
fn push_function(stack: Stack<'_>, main: Stack<'_>, frame: FrameId) {
    let coroutine = frames::coroutine(main, frame.coroutine);
    if !coroutine.is_some_and(|coroutine| stack.push_running_function(coroutine, frame.below)) {
        stack.push_nil();
    }
}

fn paged<T>(all: Vec<T>, page: Page) -> impl Iterator<Item = T> {
    let count = if page.count == 0 {
        MAX_ENTRIES
    } else {
        page.count
    };
    all.into_iter().skip(page.start).take(count)
}

fn locals(stack: Stack<'_>, main: Stack<'_>, frame: FrameId, page: Page) -> Vec<Variable> {
    let Some(coroutine) = frames::coroutine(main, frame.coroutine) else {
        return Vec::new();
    };
    let visible = visible(coroutine.local_variables(frame.below));
    let shown = paged(visible, page).filter_map(|(name, number)| {
        let is_there = stack.push_local(coroutine, frame.below, number);
        is_there.then(|| popped(stack, name))
    });
    shown.collect()
}

/// Those that no inner variable of the same name hides.
fn visible(all: Vec<(String, c_int)>) -> Vec<(String, c_int)> {
    let hidden = |i: usize| all[i + 1..].iter().any(|(name, _)| *name == all[i].0);
    let kept = (0..all.len()).filter(|&i| !hidden(i));
    kept.map(|i| all[i].clone()).collect()
}

/// The value on top, which is popped.
fn popped(stack: Stack<'_>, name: String) -> Variable {
    let variable = describe(stack, -1, name);
    stack.pop(1);
    variable
}

/// The upvalues of the function on top.
fn upvalues(stack: Stack<'_>, page: Page) -> Vec<Variable> {
    let names = stack.upvalue_names(-1);
    let names = names.into_iter().filter(|(name, _)| name != "_ENV");
    let shown = paged(names.collect(), page).filter_map(|(name, number)| {
        let is_there = stack.push_upvalue_of(-1, number);
        is_there.then(|| popped(stack, name))
    });
    shown.collect()
}

/// What is in the value on top.
fn contents(stack: Stack<'_>, page: Page) -> Vec<Variable> {
    match stack.kind(-1) {
        Type::Table => table(stack, page),
        Type::Function => upvalues(stack, page),
        Type::UserData => metatable(stack),
        _ => Vec::new(),
    }
}

fn table(stack: Stack<'_>, page: Page) -> Vec<Variable> {
    let (table, mut shown) = (stack.top(), Vec::new());
    if page.kind != Some(PageKind::Named) {
        let all: Vec<usize> = (1..=stack.raw_len(table)).collect();
        for i in paged(all, page) {
            stack.raw_get_index(table, numbers::count(i));
            shown.push(popped(stack, format!("[{i}]")));
        }
    }
    if page.kind != Some(PageKind::Indexed) {
        let mut named = Vec::new();
        each_field(stack, table, |key, value| {
            named.push(describe(stack, value, key_name(stack, key)));
            named.len() < MAX_ENTRIES
        });
        named.sort_by(|a, b| a.name.cmp(&b.name));
        named.extend(metatable(stack));
        shown.extend(paged(named, page));
    }
    shown
}

/// The metatable of the value on top, as one of its contents.
fn metatable(stack: Stack<'_>) -> Vec<Variable> {
    if stack.push_metatable(-1) {
        vec![popped(stack, METATABLE.into())]
    } else {
        Vec::new()
    }
}

/// Sets the variable of a container to the value on top, which stays there.
pub(super) fn assign(
    stack: Stack<'_>,
    main: Stack<'_>,
    of: Container,
    name: &str,
) -> Result<(), String> {
    let value = stack.top();
    let number = |all: Vec<(String, c_int)>| {
        let found = all.into_iter().rev().find(|(found, _)| found == name);
        found.map(|(_, number)| number)
    };
    let is_set = match of {
        Container::Locals(frame) => {
            let coroutine = frames::coroutine(main, frame.coroutine);
            let known = coroutine.and_then(|c| Some((c, number(c.local_variables(frame.below))?)));
            known.is_some_and(|(coroutine, number)| {
                stack.push_value(value);
                stack.set_local_of(coroutine, frame.below, number);
                true
            })
        }
        Container::Upvalues(frame) => {
            push_function(stack, main, frame);
            set_upvalue(stack, value, name)
        }
        Container::Globals => {
            stack.push_globals();
            set_entry(stack, value, name)
        }
        Container::Value(number) => match push(stack, number) {
            Type::Table => set_entry(stack, value, name),
            Type::Function => set_upvalue(stack, value, name),
            _ => false,
        },
    };
    stack.set_top(value);
    is_set
        .then_some(())
        .ok_or_else(|| format!("there is no variable {name} to set"))
}

/// Sets an upvalue of the function on top.
fn set_upvalue(stack: Stack<'_>, value: c_int, name: &str) -> bool {
    let names = stack.upvalue_names(-1);
    let Some((_, number)) = names.into_iter().find(|(found, _)| found == name) else {
        return false;
    };
    stack.push_value(value);
    stack.set_upvalue_of(-2, number);
    true
}

/// Sets the entry of the table on top whose key is written like that.
fn set_entry(stack: Stack<'_>, value: c_int, name: &str) -> bool {
    let table = stack.top();
    let item = name
        .strip_prefix('[')
        .and_then(|name| name.strip_suffix(']')?.parse::<i64>().ok());
    if let Some(item) =
        item.filter(|item| (1..=numbers::count(stack.raw_len(table))).contains(item))
    {
        stack.push_value(value);
        stack.raw_set_index(table, item);
        return true;
    }
    let mut entries = stack.entries(table);
    while entries.advance() {
        if key_name(stack, entries.key()) == name {
            stack.push_value(entries.key());
            stack.push_value(value);
            stack.raw_set(table);
            return true;
        }
    }
    false
}
