// The server with the protocol library that VS Code's own client is made of, and the grammars with its colouring engine.
// CNCTRANS names the program.
const assert = require("node:assert");
const fs = require("node:fs");
const path = require("node:path");
const test = require("node:test");
const { spawn } = require("node:child_process");
const { createProtocolConnection, StreamMessageReader, StreamMessageWriter, InitializeRequest, InitializedNotification, DidOpenTextDocumentNotification,
  PublishDiagnosticsNotification, HoverRequest, CompletionRequest, ExecuteCommandRequest, ShutdownRequest, ExitNotification } = require("vscode-languageserver-protocol/node");
const { languages, settingsFrom, translationText } = require("../shared");

const program = process.env.CNCTRANS || "cnctrans";

test("the server speaks to VS Code's client library", async () => {
  const server = spawn(program, ["lsp", "--stdio"]);
  const connection = createProtocolConnection(new StreamMessageReader(server.stdout), new StreamMessageWriter(server.stdin));
  connection.listen();
  const start = await connection.sendRequest(InitializeRequest.type, { processId: process.pid, rootUri: null, capabilities: {}, initializationOptions: settingsFrom(new Map()) });
  assert.ok(start.capabilities.hoverProvider && start.capabilities.renameProvider.prepareProvider);
  await connection.sendNotification(InitializedNotification.type, {});
  const published = new Promise((done) => connection.onNotification(PublishDiagnosticsNotification.type, done));
  const uri = "file:///part.mpf";
  await connection.sendNotification(DidOpenTextDocumentNotification.type, { textDocument: { uri, languageId: "sinumerik", version: 1, text: "G17 G90 G94 G71\nG54\nT1 D1\nM6\nS900 M3\nG0 X0 Y0 Z50\nG1 Z-1 F100\nG9999\nM30\n" } });
  const { diagnostics } = await published;
  assert.deepStrictEqual(diagnostics.map((d) => [d.range.start.line, d.severity]), [[7, 1]]);
  const hover = await connection.sendRequest(HoverRequest.type, { textDocument: { uri }, position: { line: 6, character: 1 } });
  assert.match(hover.contents.value, /line at feed to Z-1/);
  const { items } = await connection.sendRequest(CompletionRequest.type, { textDocument: { uri }, position: { line: 8, character: 0 } });
  assert.ok(items.some((i) => i.label === "CYCLE83"));
  const refused = await connection.sendRequest(ExecuteCommandRequest.type, { command: "cnctrans.translate", arguments: [uri, "fagor"] });
  assert.ok(refused.refused);
  assert.match(translationText(refused), /line 8: \*\*error/);
  await connection.sendRequest(ShutdownRequest.type);
  await connection.sendNotification(ExitNotification.type);
  await new Promise((done) => server.on("exit", (status) => done(assert.strictEqual(status, 0))));
});

test("the grammars colour what they are made for", async () => {
  const textmate = require("vscode-textmate");
  const oniguruma = require("vscode-oniguruma");
  await oniguruma.loadWASM(fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
  const onigLib = Promise.resolve({ createOnigScanner: (p) => new oniguruma.OnigScanner(p), createOnigString: (s) => new oniguruma.OnigString(s) });
  const load = async (scope) => textmate.parseRawGrammar(fs.readFileSync(path.join(__dirname, "..", "syntaxes", scope.replace("source.", "") + ".tmLanguage.json"), "utf8"), "x.json");
  const registry = new textmate.Registry({ onigLib, loadGrammar: load });
  const cases = {
    fagor: ["N10 (IF P110 LT 3 GOTO N10) ;TEXT", { N10: "block-number", IF: "keyword.control", P110: "variable", ";TEXT": "comment" }],
    num: ["N20 G1 X10 Z-L1 (TEXT)", { N20: "block-number", G1: "keyword.other", L1: "variable", "(TEXT)": "comment" }],
    sinumerik: ['CYCLE81(10,0,2,R1) MSG("A")', { CYCLE81: "support.function.cycle", R1: "variable", '"A"': "string" }],
    heidenhain: ["5 CALL LBL 1 REP 2", { 5: "block-number", "CALL LBL": "keyword.control" }],
  };
  assert.deepStrictEqual(Object.keys(cases).sort(), languages.map((l) => l.id).sort());
  for (const [dialect, [line, expected]] of Object.entries(cases)) {
    const grammar = await registry.loadGrammar("source." + dialect);
    const tokens = grammar.tokenizeLine(line, textmate.INITIAL).tokens;
    for (const [word, scope] of Object.entries(expected)) {
      const found = tokens.filter((t) => line.slice(t.startIndex, t.endIndex).trim() === word).map((t) => t.scopes.join(" "));
      assert.ok(found.length && found[0].includes(scope), `${dialect}: ${word} is ${found}`);
    }
  }
});
