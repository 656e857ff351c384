//! `#[api("sim.name")]`: turns a plain Rust function into a scriptable one.
//!
//! The function stays as written. Next to it, in a module of the same name, the macro puts `API`:
//! its name, documentation, parameters, result type and call glue. Everything else (registration,
//! reference, editor stubs, coverage) reads those rows.

use proc_macro::TokenStream;
use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::{Expr, FnArg, ItemFn, Lit, LitStr, Meta, Pat, PatType, ReturnType, Token, Type, parse_macro_input};

/// See the crate's documentation. Parameters get their name in camel case, or, with `#[api("simZMQ.name", snake_case)]`,
/// as written. The first parameter is the context, `&Cx` (reads) or `&mut Cx`
/// (writes, or calls scripts); the others implement `FromScript`; the result is `Result<T>` with
/// `T: IntoScript`. `#[default(expr)]` makes a parameter optional, and so does the type `Option`.
#[proc_macro_attribute]
pub fn api(name: TokenStream, item: TokenStream) -> TokenStream {
    let attribute = parse_macro_input!(name as Attribute);
    let mut function = parse_macro_input!(item as ItemFn);
    expand(&attribute, &mut function).unwrap_or_else(syn::Error::into_compile_error).into()
}

/// `"sim.name"`, or `"simZMQ.name", snake_case` for a function whose parameters keep their names.
struct Attribute {
    name: LitStr,
    is_snake_case: bool,
}

impl Parse for Attribute {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse()?;
        let is_snake_case = input.parse::<Option<Token![,]>>()?.is_some();
        if is_snake_case {
            let word: syn::Ident = input.parse()?;
            if word != "snake_case" {
                return Err(syn::Error::new(word.span(), "expected `snake_case`"));
            }
        }
        Ok(Self { name, is_snake_case })
    }
}

fn expand(attribute: &Attribute, function: &mut ItemFn) -> syn::Result<Tokens> {
    let Attribute { name, is_snake_case } = attribute;
    let ident = function.sig.ident.clone();
    let doc = doc_text(function);
    let output = output_type(function)?;
    let results = result_types(output.clone());
    let mut inputs = function.sig.inputs.iter_mut();
    let mutates = takes_mut_context(inputs.next())?;
    let parameters = inputs.map(|input| parameter(input, *is_snake_case)).collect::<syn::Result<Vec<_>>>()?;

    let required = parameters.iter().rposition(Parameter::is_required).map_or(0, |last| last + 1);
    let rows = parameters.iter().map(Parameter::row);
    let decoders = parameters.iter().map(Parameter::decoder);
    let locals = parameters.iter().map(|p| &p.ident);
    let context = if mutates { quote!(&mut cx) } else { quote!(&cx) };
    Ok(quote! {
        #function

        #[allow(non_snake_case, unused_imports, clippy::wildcard_imports)]
        pub(crate) mod #ident {
            use super::*;
            use ::script::{ApiFn, Args, FromScript, IntoScript, Param, Source, Values};

            pub(crate) const API: ApiFn = ApiFn {
                name: #name,
                doc: #doc,
                params: &[#(#rows),*],
                returns: &[#(<#results as IntoScript>::TYPE),*],
                mutates: #mutates,
                call,
                call_data,
            };

            fn call(args: &mut Args<'_>) -> Result<std::ffi::c_int> {
                let out = perform(args)?;
                args.finish(out)
            }

            fn call_data<'a>(args: &mut Args<'a, Values<'a>>) -> Result<Vec<::scene::Data>> {
                let mut results = Vec::new();
                perform(args)?.into_script(&mut results)?;
                Ok(results)
            }

            #[inline(always)]
            fn perform<'a, S: Source<'a>>(args: &mut Args<'a, S>) -> Result<#output> {
                args.require(#required)?;
                #(#decoders)*
                let mut cx = args.context()?;
                let _ = &mut cx;
                super::#ident(#context, #(#locals),*)
            }
        }
    })
}

struct Parameter {
    ident: syn::Ident,
    ty: Type,
    lua_name: String,
    default: Option<Expr>,
    variadic: bool,
}

impl Parameter {
    fn is_required(&self) -> bool {
        let words_its_absence = is_named(&self.ty, "Checked") || is_named(&self.ty, "SensorArgument");
        self.default.is_none() && !self.variadic && !is_named(&self.ty, "Option") && !words_its_absence
    }

    fn row(&self) -> Tokens {
        let Self { ty, lua_name, .. } = self;
        let default = match &self.default {
            Some(value) => {
                let text = quote!(#value).to_string().replace(' ', "");
                quote!(Some(#text))
            }
            None if is_named(ty, "Option") => quote!(Some("None")),
            None => quote!(None),
        };
        quote!(Param { name: #lua_name, ty: <#ty as FromScript>::TYPE, default: #default })
    }

    fn decoder(&self) -> Tokens {
        let Self { ident, ty, .. } = self;
        match &self.default {
            Some(value) => quote!(let #ident: #ty = args.take_or(|| (#value).into())?;),
            None => quote!(let #ident: #ty = args.take()?;),
        }
    }
}

fn parameter(input: &mut FnArg, is_snake_case: bool) -> syn::Result<Parameter> {
    let FnArg::Typed(PatType { attrs, pat, ty, .. }) = input else {
        return Err(syn::Error::new_spanned(input, "`self` is not scriptable"));
    };
    let Pat::Ident(pat) = &**pat else {
        return Err(syn::Error::new_spanned(pat, "parameters need a plain name"));
    };
    let default = match attrs.iter().position(|a| a.path().is_ident("default")) {
        Some(at) => Some(attrs.remove(at).parse_args()?),
        None => None,
    };
    let ident = pat.ident.clone();
    let variadic = is_named(ty, "Rest");
    let rust_name = ident.to_string();
    let lua_name = match rust_name.trim_start_matches("r#") {
        _ if variadic => "...".to_owned(),
        name if is_snake_case => name.to_owned(),
        name => camel_case(name),
    };
    Ok(Parameter { ident, ty: (**ty).clone(), lua_name, default, variadic })
}

fn is_named(ty: &Type, name: &str) -> bool {
    matches!(ty, Type::Path(path) if path.path.segments.last().is_some_and(|s| s.ident == name))
}

fn doc_text(function: &ItemFn) -> String {
    let lines = function.attrs.iter().filter_map(|attr| match &attr.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
            Expr::Lit(literal) => match &literal.lit {
                Lit::Str(text) => Some(text.value().trim().to_owned()),
                _ => None,
            },
            _ => None,
        },
        _ => None,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The `T` of `-> Result<T>`.
fn output_type(function: &ItemFn) -> syn::Result<Type> {
    if let ReturnType::Type(_, ty) = &function.sig.output
        && let Type::Path(path) = &**ty
        && let Some(last) = path.path.segments.last()
        && let syn::PathArguments::AngleBracketed(args) = &last.arguments
        && let Some(syn::GenericArgument::Type(ty)) = args.args.first()
    {
        return Ok(ty.clone());
    }
    Err(syn::Error::new_spanned(&function.sig, "a scriptable function returns `Result<T>`"))
}

/// Several results are a tuple, none is `()`.
fn result_types(output: Type) -> Vec<Type> {
    match output {
        Type::Tuple(tuple) => tuple.elems.into_iter().collect(),
        single => vec![single],
    }
}

fn takes_mut_context(first: Option<&mut FnArg>) -> syn::Result<bool> {
    match first {
        Some(FnArg::Typed(PatType { ty, .. })) => match &**ty {
            Type::Reference(reference) => Ok(reference.mutability.is_some()),
            other => Err(syn::Error::new_spanned(other, "the first parameter is `&Cx` or `&mut Cx`")),
        },
        _ => Err(syn::Error::new(proc_macro2::Span::call_site(), "the first parameter is `&Cx` or `&mut Cx`")),
    }
}

fn camel_case(snake: &str) -> String {
    let mut words = snake.split('_');
    let mut out = words.next().unwrap_or_default().to_owned();
    for word in words {
        let mut letters = word.chars();
        out.extend(letters.next().map(|c| c.to_ascii_uppercase()));
        out.push_str(letters.as_str());
    }
    out
}
