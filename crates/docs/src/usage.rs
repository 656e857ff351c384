//! Which functions of the simulator Lua code uses, and whether they work here.
//!
//! Counted are members of `sim` and of CoppeliaSim's modules, under their names or those a `require` gave them, and the names from
//! before there were modules (`simGetObjectHandle`). It reads code and runs nothing: what a script builds names from stays unseen.

use std::collections::{HashMap, HashSet};
use std::sync::LazyLock;

use super::approximated::difference;
use super::lua_tokens::{Kind, Token, tokens};
use super::{module_stubs, modules};
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
}

impl Use {
    /// What to call instead, where the name is deprecated or missing and the other one is here.
    pub fn instead(&self) -> Option<&'static str> {
        super::remedy(&self.name)
    }
}

/// Everything of the simulator that `code` uses, in its order, scripts in its strings included (`sim.createScript`).
pub fn uses(code: &[u8]) -> Vec<Use> {
    uses_within(code, 0)
}

fn uses_within(code: &[u8], depth: usize) -> Vec<Use> {
    let tokens = tokens(code);
    let scope = Scope::of(&tokens);
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match &token.kind {
            Kind::Name(name) if !is_definition(&tokens, at) => {
                found.extend(scope.member(name, is_call(&tokens, at), token.line));
            }
            Kind::Text(text) if required_at(&tokens, at) => {
                found.extend(required(&String::from_utf8_lossy(text), token.line));
            }
            Kind::Text(text) if depth < MAX_SCRIPT_DEPTH && is_code(&tokens, at) => {
                found.extend(uses_of_text(text, token.line, depth));
            }
            _ => {}
        }
    }
    found
}

/// Uses of a script in a string that begins in a line.
fn uses_of_text(text: &[u8], line: usize, depth: usize) -> Vec<Use> {
    let is_quoted = !text.contains(&b'\n');
    let code = if is_quoted {
        unescaped(text)
    } else {
        text.to_vec()
    };
    let mut found = uses_within(&code, depth + 1);
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
    vec![Use {
        name,
        written: None,
        line: 1,
        support: Support::Missing,
    }]
}

/// Functions that only scripts in Python have.
const OF_PYTHON: [&str; 2] = ["testCB", "protectedCalls"];

/// The use of a member of a module in a script in Python; None for what is no function of CoppeliaSim's.
pub fn use_of_member(module: &str, member: &str, line: usize, is_call: bool) -> Option<Use> {
    let support = match module {
        "sim" if OF_PYTHON.contains(&member) => Support::Works,
        "sim" => of_sim(member)?,
        _ => of_module(module, member, is_call)?,
    };
    Some(Use {
        name: format!("{module}.{member}"),
        written: None,
        line,
        support,
    })
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
        let support = if module == "sim" {
            of_sim(member)?
        } else {
            of_module(module, member, is_call)?
        };
        let written = is_old.then(|| written.to_owned());
        Some(Use {
            name: format!("{module}.{member}"),
            written,
            line,
            support,
        })
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
    let equals = require_of(tokens, at)?.checked_sub(1)?;
    match &tokens[equals.checked_sub(1)?].kind {
        Kind::Name(name) if tokens[equals].kind == Kind::Sign(b'=') => Some(name),
        _ => None,
    }
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
        name: module.to_owned(),
        written: None,
        line,
        support,
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
        name: written.to_owned(),
        written: None,
        line,
        support,
    })
}

/// None for constants, which are no functions.
fn of_sim(member: &str) -> Option<Support> {
    match ::modules::registry().members_of_sim().get(member) {
        Some(Member::Constant(_)) => None,
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
        Some(functions) if functions.contains(member) => {
            Some(of_function(&format!("{module}.{member}")))
        }
        Some(_) if !is_call => None,
        _ => Some(Support::Missing),
    }
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
mod tests {
    use super::{Support, uses};

    fn names(code: &str) -> Vec<String> {
        uses(code.as_bytes())
            .into_iter()
            .map(|found| found.name)
            .collect()
    }

    fn supports(code: &str) -> Vec<Support> {
        uses(code.as_bytes())
            .into_iter()
            .map(|found| found.support)
            .collect()
    }

    #[test]
    fn names_lines_and_support() {
        let found = uses(
            b"sim = require 'sim'\nlocal h = sim.getObject('/a') -- sim.f()\nsim.frobnicate()",
        );
        assert_eq!(
            (found[0].name.as_str(), found[0].line, found[0].support),
            ("sim.getObject", 2, Support::Works)
        );
        assert_eq!(
            (found[1].name.as_str(), found[1].line, found[1].support),
            ("sim.frobnicate", 3, Support::Missing)
        );
        assert_eq!(found.len(), 2);
    }

    #[test]
    fn constants_and_functions_of_the_file_do_not_count() {
        assert!(
            names("x = sim.handle_self; sim.mine = 1; function sim.f() end sim.f(sim.mine) print(simulate)").is_empty()
        );
        assert_eq!(names("if sim.getObject == nil then end"), ["sim.getObject"]);
    }

    #[test]
    fn names_a_require_gives() {
        assert_eq!(
            names("local s = require('sim')\ns.getObject('/a')"),
            ["sim.getObject"]
        );
        assert_eq!(names("local cmd=require'mine'\ncmd.f()"), [""; 0]);
        assert_eq!(
            supports("z = require 'simZMQ' z.ctx_new() z.PUB() z.PUB"),
            [Support::Works, Support::Missing]
        );
    }

    #[test]
    fn scripts_in_strings() {
        let found = uses(b"sim.createScript(sim.scripttype_customization, [[\nlocal sim = require 'sim'\nsim.frobnicate()\n]], 0, 'lua')");
        let named: Vec<_> = found
            .iter()
            .map(|one| (one.name.as_str(), one.line))
            .collect();
        assert_eq!(named, [("sim.createScript", 1), ("sim.frobnicate", 3)]);
        assert_eq!(
            names(r#"load("x = 1 sim.frobnicate(\"a\")")"#),
            ["sim.frobnicate"]
        );
        assert_eq!(names("print('sim.frobnicate()')"), [""; 0]);
    }

    #[test]
    fn variables_with_the_names_of_modules() {
        assert_eq!(
            names(
                "local zmq = require 'simZMQ' local socket = zmq.socket(c, 1) socket.frobnicate(1)"
            ),
            ["simZMQ.socket"]
        );
        assert_eq!(names("local a, socket = f() socket.frobnicate()"), [""; 0]);
        assert_eq!(names("function f(socket) socket.frobnicate() end"), [""; 0]);
        assert_eq!(
            names("local socket = require('socket').tcp() socket.frobnicate()"),
            [""; 0]
        );
        assert_eq!(
            supports("socket = require 'socket' socket.connect('a', 1) socket.frobnicate()"),
            [Support::Works, Support::Missing]
        );
    }

    #[test]
    fn globals_of_v_rep() {
        assert_eq!(
            supports("simAddObjectCustomData(1, 2, 'x') simHandlePath(1, 2)"),
            [Support::Works; 2]
        );
        assert_eq!(supports("simFrobnicate(1)"), [Support::Missing]);
        assert_eq!(
            names("simTime = 1 simTime() print(simulate, sim_handle_all, simple())"),
            [""; 0]
        );
    }

    #[test]
    fn old_names() {
        let found = &uses(b"simGetObjectHandle('a', sim_handle_all)")[..];
        assert_eq!(found.len(), 1);
        assert_eq!(
            (found[0].name.as_str(), found[0].written.as_deref()),
            ("sim.getObjectHandle", Some("simGetObjectHandle"))
        );
        assert_eq!(names("simExtCustomUI_create('')"), ["simUI.create"]);
    }
}
