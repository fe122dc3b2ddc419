"""A client of the language server: starts it, sends requests, waits for answers and diagnostics."""
import json
import os
import subprocess
import time


class Client:
    def __init__(self, cnctrans, options=None):
        self.process = subprocess.Popen([cnctrans, "lsp", "--stdio"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.next_id = 0
        self.diagnostics = {}
        self.messages = []
        self.versions = {}
        self.latency = {}
        self.capabilities = self.request("initialize", {"processId": None, "rootUri": None, "capabilities": {}, "initializationOptions": options or {}})
        self.notify("initialized", {})

    def send(self, message):
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
        self.process.stdin.flush()

    def receive(self):
        length = 0
        while True:
            line = self.process.stdout.readline()
            if not line:
                raise EOFError("the server has gone")
            if not line.strip():
                break
            name, value = line.split(b":")
            if name.lower() == b"content-length":
                length = int(value)
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        elif message.get("method") == "window/showMessage":
            self.messages.append(message["params"]["message"])
        return message

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def request(self, method, params):
        self.next_id += 1
        begin = time.perf_counter()
        self.send({"id": self.next_id, "method": method, "params": params})
        while True:
            message = self.receive()
            if message.get("id") == self.next_id and "method" not in message:
                break
        self.latency[method] = (time.perf_counter() - begin) * 1000
        if "error" in message:
            raise RuntimeError(message["error"]["message"])
        return message["result"]

    def wait_diagnostics(self, uri):
        self.diagnostics.pop(uri, None)
        while uri not in self.diagnostics:
            self.receive()
        return self.diagnostics[uri]

    def open(self, uri, language, text):
        self.versions[uri] = 1
        self.notify("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": language, "version": 1, "text": text}})
        return self.wait_diagnostics(uri)

    def edit(self, uri, line, begin, end, text):
        """Replaces a part of a line; the diagnostics behind it and how long they took (ms)."""
        self.versions[uri] += 1
        started = time.perf_counter()
        self.notify("textDocument/didChange", {"textDocument": {"uri": uri, "version": self.versions[uri]},
                    "contentChanges": [{"range": {"start": {"line": line, "character": begin}, "end": {"line": line, "character": end}}, "text": text}]})
        found = self.wait_diagnostics(uri)
        return found, (time.perf_counter() - started) * 1000

    def at(self, method, uri, line, character, **more):
        return self.request("textDocument/" + method, {"textDocument": {"uri": uri}, "position": {"line": line, "character": character}, **more})

    def cpu(self):
        """Seconds of processor time that the server has used."""
        with open(f"/proc/{self.process.pid}/stat", encoding="ascii") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def of(self, method, uri, **more):
        return self.request("textDocument/" + method, {"textDocument": {"uri": uri}, **more})

    def command(self, command, *arguments):
        return self.request("workspace/executeCommand", {"command": command, "arguments": list(arguments)})

    def close(self):
        self.request("shutdown", None)
        self.notify("exit", None)
        status = self.process.wait(timeout=10)
        self.process.stdin.close()
        self.process.stdout.close()
        return status
