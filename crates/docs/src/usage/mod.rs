//! Which functions of the simulator Lua code uses, and whether they work here.
//!
//! Counted are members of `sim` and of CoppeliaSim's modules, under their names or those a `require` gave them, and the names from
//! before there were modules (`simGetObjectHandle`). It reads code and runs nothing: what a script builds names from stays unseen.

use std::collections::{HashMap, HashSet};
use std::path::Path;
use std::sync::LazyLock;

use super::approximated::difference;
use super::lua::tokens::{Kind, Token, tokens};
use super::modules;
use super::stubs::modules as module_stubs;
use super::suspicions::{instead_of_module, is_later, meant, unknown_callback, unknown_module};
use format::scene_file::old_names;
use script::{Member, ReferenceModule, member_by_rule};

/// Scripts in strings of scripts in strings are read up to here.
const MAX_SCRIPT_DEPTH: usize = 4;
/// An argument is looked for up to so many tokens after the name of the function.
const MAX_ARGUMENT_TOKENS: usize = 100;

/// Support for a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Support {
    /// It works as in CoppeliaSim.
    Works,
    /// It does less than in CoppeliaSim: what is different.
    Approximated(&'static str),
    /// It raises an error, or is nil.
    Missing,
}

/// One place where code names something of the simulator.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Use {
    /// As it would be called today: `sim.getObject`, `simUI.create`, or the name of a module.
    pub name: String,
    /// The old name used in the code, if different.
    pub written: Option<String>,
    /// The line, from 1.
    pub line: usize,
    /// How far it is supported.
    pub support: Support,
    /// What else is known of what is missing, such as the name that was probably meant.
    pub hint: Option<String>,
}

impl Use {
    fn of_member(
        module: &str,
        member: &str,
        written: Option<String>,
        line: usize,
        support: Support,
    ) -> Self {
        let name = format!("{module}.{member}");
        let hint = || is_later(&name).or_else(|| meant(module, member));
        let hint = (support == Support::Missing).then(hint).flatten();
        Self {
            written,
            support,
            hint,
            ..Self::missing(name, line)
        }
    }

    /// What to call instead, where the name is deprecated or missing and the other one is here.
    pub fn instead(&self) -> Option<&'static str> {
        super::remedy(&self.name)
    }
}

/// Everything of the simulator that `code` uses, in its order, scripts in its strings included (`sim.createScript`).
pub fn uses(code: &[u8]) -> Vec<Use> {
    uses_within(code, None, 0)
}

/// The same of a script whose own modules are in `folder`: modules that are nowhere are missing too.
pub fn uses_beside(code: &[u8], folder: &Path) -> Vec<Use> {
    // Where a script changes its path, its modules may be anywhere.
    let text = String::from_utf8_lossy(code);
    let has_own_path = text.contains("package.path") || text.contains("package.cpath");
    uses_within(code, Some(folder).filter(|_| !has_own_path), 0)
}

fn uses_within(code: &[u8], folder: Option<&Path>, depth: usize) -> Vec<Use> {
    let tokens = tokens(code);
    let scope = Scope::of(&tokens);
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match &token.kind {
            Kind::Name(name) if !is_definition(&tokens, at) => {
                found.extend(scope.member(name, is_call(&tokens, at), token.line));
            }
            Kind::Name(_) => found.extend(unknown_callback(&tokens, at)),
            Kind::Text(text) if required_at(&tokens, at) => {
                let name = String::from_utf8_lossy(text);
                found.extend(required(&name, token.line));
                found.extend(unknown_module(&name, folder, token.line));
            }
            Kind::Text(text) if depth < MAX_SCRIPT_DEPTH && is_code(&tokens, at) => {
                found.extend(uses_of_text(text, token.line, folder, depth));
            }
            _ => {}
        }
    }
    found
}

/// Uses of a script in a string that begins in a line.
fn uses_of_text(text: &[u8], line: usize, folder: Option<&Path>, depth: usize) -> Vec<Use> {
    let is_quoted = !text.contains(&b'\n');
    let code = if is_quoted {
        unescaped(text)
    } else {
        text.to_vec()
    };
    let mut found = uses_within(&code, folder, depth + 1);
    for one in &mut found {
        one.line = if is_quoted { line } else { line + one.line - 1 };
    }
    found
}

/// The content of a string between quotes, as far as code needs it.
fn unescaped(text: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    let mut rest = text.iter();
    while let Some(&byte) = rest.next() {
        match byte {
            b'\\' => out.extend(
                rest.next()
                    .map(|&escaped| if escaped == b'n' { b'\n' } else { escaped }),
            ),
            _ => out.push(byte),
        }
    }
    out
}

/// Whether a string is an argument of a function that runs code.
fn is_code(tokens: &[Token<'_>], at: usize) -> bool {
    let mut open = 0_usize;
    for place in (at.saturating_sub(MAX_ARGUMENT_TOKENS)..at).rev() {
        match tokens[place].kind {
            Kind::Sign(b')' | b'}' | b']') => open += 1,
            Kind::Sign(b'(' | b'{' | b'[') if open > 0 => open -= 1,
            Kind::Sign(b'(') => {
                return place > 0
                    && matches!(&tokens[place - 1].kind, Kind::Name(name) if runs_code(name));
            }
            Kind::Sign(b'{' | b'[') => return false,
            _ => {}
        }
    }
    false
}

fn runs_code(function: &str) -> bool {
    let last = function.rsplit('.').next().unwrap_or(function);
    let last = last.strip_prefix("sim").unwrap_or(last);
    [
        "createScript",
        "CreateScript",
        "setScriptText",
        "SetScriptText",
        "executeScriptString",
        "ExecuteScriptString",
    ]
    .contains(&last)
        || ["load", "loadstring"].contains(&function)
}

/// Uses of a script in an unknown language: that language, which is missing.
pub fn foreign_script(language: &str) -> Vec<Use> {
    missing_script(format!("scripts in {language}"))
}

/// Uses of a script that cannot be read, for that reason.
pub fn unreadable_script(reason: &str) -> Vec<Use> {
    missing_script(format!("a script that cannot be read ({reason})"))
}

fn missing_script(name: String) -> Vec<Use> {
    vec![Use::missing(name, 1)]
}

/// Functions that only scripts in Python have.
const OF_PYTHON: [&str; 2] = ["testCB", "protectedCalls"];

/// The use of a member of a module in a script in Python; None for what is no function of CoppeliaSim's.
pub fn use_of_member(module: &str, member: &str, line: usize, is_call: bool) -> Option<Use> {
    let support = match module {
        "sim" if OF_PYTHON.contains(&member) => Support::Works,
        "sim" => of_sim(member, is_call)?,
        _ => of_module(module, member, is_call)?,
    };
    Some(Use::of_member(module, member, None, line, support))
}

/// The use of a module in a script in Python; None if it works, or is not CoppeliaSim's.
pub fn use_of_module(module: &str, line: usize) -> Option<Use> {
    required(module, line)
}

/// The meaning of the names in one file.
struct Scope {
    /// Variables that hold a module.
    modules: HashMap<String, String>,
    /// Names that the file itself defines.
    own: HashSet<String>,
}

impl Scope {
    fn of(tokens: &[Token<'_>]) -> Self {
        let mut scope = Self {
            modules: HashMap::new(),
            own: HashSet::new(),
        };
        for (at, token) in tokens.iter().enumerate() {
            match &token.kind {
                Kind::Name(name) if is_definition(tokens, at) || is_declared(tokens, at) => {
                    scope.own.insert(name.clone());
                }
                Kind::Text(text) if required_at(tokens, at) => {
                    if let Some(variable) = variable_of_require(tokens, at) {
                        scope.modules.insert(
                            variable.to_owned(),
                            String::from_utf8_lossy(text).into_owned(),
                        );
                    }
                }
                _ => {}
            }
        }
        scope
    }

    fn member(&self, written: &str, is_call: bool, line: usize) -> Option<Use> {
        if self.own.contains(written) {
            return None;
        }
        let (name, is_old) = match current_name(written) {
            Some(name) => (name, true),
            None => (written.to_owned(), false),
        };
        let Some((owner, rest)) = name.split_once('.') else {
            return global(written, is_call, line);
        };
        let member = rest.split('.').next()?;
        // A variable of the script that has the name of a module.
        if !owner.starts_with("sim")
            && self.own.contains(owner)
            && !self.modules.contains_key(owner)
        {
            return None;
        }
        let module = self.modules.get(owner).map_or(owner, String::as_str);
        let module = without_generation(module);
        let support = if module == "sim" {
            of_sim(member, is_call)?
        } else {
            of_module(module, member, is_call)?
        };
        let written = is_old.then(|| written.to_owned());
        Some(Use::of_member(module, member, written, line, support))
    }
}

/// Whether the name is given a value here, as a variable or a function.
fn is_definition(tokens: &[Token<'_>], at: usize) -> bool {
    let is = |at: usize, sign: u8| {
        tokens
            .get(at)
            .is_some_and(|token| token.kind == Kind::Sign(sign))
    };
    let after_function = at > 0 && is_word(&tokens[at - 1], "function");
    after_function || is(at + 1, b'=') && !is(at + 2, b'=')
}

fn is_call(tokens: &[Token<'_>], at: usize) -> bool {
    matches!(
        tokens.get(at + 1).map(|token| &token.kind),
        Some(Kind::Sign(b'(' | b'{') | Kind::Text(_))
    )
}

fn is_word(token: &Token<'_>, word: &str) -> bool {
    matches!(&token.kind, Kind::Name(name) if name == word)
}

/// The place of the word `require` whose argument the text at `at` is.
fn require_of(tokens: &[Token<'_>], at: usize) -> Option<usize> {
    let before = at.checked_sub(1)?;
    let word = if tokens[before].kind == Kind::Sign(b'(') {
        before.checked_sub(1)?
    } else {
        before
    };
    is_word(&tokens[word], "require").then_some(word)
}

fn required_at(tokens: &[Token<'_>], at: usize) -> bool {
    require_of(tokens, at).is_some()
}

/// Whether the name is declared here: in a list behind `local`, as a parameter, or by a `for`.
fn is_declared(tokens: &[Token<'_>], at: usize) -> bool {
    let is_plain =
        |token: &Token<'_>| matches!(&token.kind, Kind::Name(name) if !name.contains('.'));
    if !is_plain(&tokens[at]) {
        return false;
    }
    let mut place = at;
    while place >= 2 && tokens[place - 1].kind == Kind::Sign(b',') && is_plain(&tokens[place - 2]) {
        place -= 2;
    }
    let Some(before) = place.checked_sub(1) else {
        return false;
    };
    let is_parameter = tokens[before].kind == Kind::Sign(b'(')
        && (1..=2).any(|back| {
            before
                .checked_sub(back)
                .is_some_and(|at| is_word(&tokens[at], "function"))
        });
    is_parameter || is_word(&tokens[before], "local") || is_word(&tokens[before], "for")
}

/// The variable of `name = require 'module'`; not of what a function or member of the module yields.
fn variable_of_require<'a>(tokens: &'a [Token<'_>], at: usize) -> Option<&'a str> {
    let is_closed = tokens
        .get(at + 1)
        .is_some_and(|token| token.kind == Kind::Sign(b')'));
    let after = tokens.get(if is_closed { at + 2 } else { at + 1 });
    if after.is_some_and(|token| matches!(token.kind, Kind::Sign(b'.' | b':' | b'[' | b'('))) {
        return None;
    }
    let (equals, place) = place_in_list(tokens, require_of(tokens, at)?)?;
    names_before(tokens, equals).get(place).copied()
}

/// The `=` of the assignment whose values a value is among, and how many stand before it.
fn place_in_list(tokens: &[Token<'_>], value: usize) -> Option<(usize, usize)> {
    let (mut open, mut before) = (0_usize, 0);
    for place in (value.saturating_sub(MAX_ARGUMENT_TOKENS)..value).rev() {
        match tokens[place].kind {
            Kind::Sign(b')' | b'}' | b']') => open += 1,
            Kind::Sign(b'(' | b'{' | b'[') => open = open.checked_sub(1)?,
            Kind::Sign(b',') if open == 0 => before += 1,
            Kind::Sign(b'=') if open == 0 => return Some((place, before)),
            _ if open == 0 && before == 0 => return None,
            _ => {}
        }
    }
    None
}

/// The names that are assigned to, in their order.
fn names_before<'a>(tokens: &'a [Token<'_>], equals: usize) -> Vec<&'a str> {
    let mut names = Vec::new();
    let mut end = equals;
    while let Some(Kind::Name(name)) = end.checked_sub(1).map(|place| &tokens[place].kind) {
        names.push(name.as_str());
        match end.checked_sub(2) {
            Some(comma) if tokens[comma].kind == Kind::Sign(b',') => end = comma,
            _ => break,
        }
    }
    names.reverse();
    names
}

/// The use of a module of CoppeliaSim that is missing here, or approximated as a whole. Other modules say so by their functions.
fn required(module: &str, line: usize) -> Option<Use> {
    let is_missing =
        CATALOGUE.reference_modules.contains(module) && !CATALOGUE.modules.contains_key(module);
    let support = if is_missing {
        Support::Missing
    } else {
        Support::Approximated(difference(module)?)
    };
    Some(Use {
        hint: is_missing.then(|| instead_of_module(module)).flatten(),
        support,
        ..Use::missing(module.to_owned(), line)
    })
}

/// Current name for an old one; None for other names.
fn current_name(written: &str) -> Option<String> {
    if written.contains('.') || !written.starts_with("sim") {
        return None;
    }
    let registry = ::modules::registry();
    let members = registry.members_of_sim();
    let by_rule = || {
        let member = member_by_rule(written).filter(|member| members.contains(member))?;
        Some(format!("sim.{member}"))
    };
    let current = members
        .of_old_name(written)
        .filter(|member| members.contains(member) && !member.starts_with('_'));
    let current = current.map(|member| format!("sim.{member}"));
    current
        .or_else(by_rule)
        .or_else(|| old_names::current(written).map(str::to_owned))
}

/// A function of V-REP that is no member of `sim`; what is called like one of them and unknown is missing.
fn global(written: &str, is_call: bool, line: usize) -> Option<Use> {
    let rest = written.strip_prefix("sim")?;
    let support = match ::modules::registry().members_of_sim().of_global(written) {
        Some(Member::Constant(_)) => return None,
        Some(Member::Native(_) | Member::Lua { .. }) => Support::Works,
        Some(Member::Missing(_)) => Support::Missing,
        None if is_call && rest.starts_with(|c: char| c.is_ascii_uppercase()) => Support::Missing,
        None => return None,
    };
    Some(Use {
        hint: member_by_rule(written).and_then(|member| meant("sim", &member)),
        support,
        ..Use::missing(written.to_owned(), line)
    })
}

/// `sim` for `sim-1` and `sim-2`, which have its functions.
fn without_generation(module: &str) -> &str {
    match module {
        "sim-1" | "sim-2" => "sim",
        other => other,
    }
}

/// None for constants, which are no functions, and for what looks like one that later versions dropped and is nil in CoppeliaSim too.
fn of_sim(member: &str, is_call: bool) -> Option<Support> {
    match ::modules::registry().members_of_sim().get(member) {
        Some(Member::Constant(_)) => None,
        None if !is_call && member.contains('_') => meant("sim", member).map(|_| Support::Missing),
        Some(Member::Missing(_)) | None => Some(Support::Missing),
        Some(_) => Some(of_function(&format!("sim.{member}"))),
    }
}

fn of_function(name: &str) -> Support {
    difference(name).map_or(Support::Works, Support::Approximated)
}

/// None for modules that are not CoppeliaSim's, and for constants of those that are here.
fn of_module(module: &str, member: &str, is_call: bool) -> Option<Support> {
    if !CATALOGUE.reference_modules.contains(module) {
        return None;
    }
    match CATALOGUE.modules.get(module) {
        Some(functions) if functions.contains(member) || is_bound(module, member) => {
            Some(of_function(&format!("{module}.{member}")))
        }
        Some(_) if !is_call => None,
        _ => Some(Support::Missing),
    }
}

/// Whether a module has a function under that name, also one that no page lists, such as an older name.
fn is_bound(module: &str, member: &str) -> bool {
    let registry = ::modules::registry();
    let found = registry
        .module(module)
        .and_then(|namespace| namespace.get(member));
    matches!(found, Some(Member::Native(_) | Member::Lua { .. }))
}

/// Functions that exist here, and those of CoppeliaSim.
struct Catalogue {
    /// The functions of each module.
    modules: HashMap<String, HashSet<String>>,
    reference_modules: HashSet<&'static str>,
}

static CATALOGUE: LazyLock<Catalogue> = LazyLock::new(|| Catalogue {
    modules: modules::names()
        .map(|name| (name.clone(), module_stubs::names(&name)))
        .collect(),
    reference_modules: ReferenceModule::all().map(|module| module.name).collect(),
});

#[cfg(test)]
mod tests;
