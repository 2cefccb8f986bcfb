// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

static std::string LastWords(const std::filesystem::path& log)
{
	std::ifstream file(log, std::ios::binary);
	std::ostringstream text;
	text << file.rdbuf();
	const std::string all = text.str();
	return all.substr(all.size() > 1500 ? all.size() - 1500 : 0);
}

static double Seconds(const timeval& time)
{
	return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

Cost RunMeasured(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::filesystem::path& log)
{
	std::vector<char*> words;
	for (const std::string& word : command)
		words.push_back(const_cast<char*>(word.c_str()));
	words.push_back(nullptr);
	const std::string folder_name = folder.string(), log_name = log.string();
	const auto start = std::chrono::steady_clock::now();
	const pid_t child = fork();
	if (child < 0)
		throw std::runtime_error(std::string("cannot start a program: ") + std::strerror(errno));
	if (child == 0)
	{
		// Between fork and exec only calls that are safe there: other threads may hold locks.
		const int out = open(log_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
		const int in = open("/dev/null", O_RDONLY);
		if (out < 0 || in < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || chdir(folder_name.c_str()) != 0)
			_exit(126);
		execvp(words[0], words.data());
		_exit(127);
	}
	int status = 0;
	rusage usage{};
	while (wait4(child, &status, 0, &usage) < 0)
		if (errno != EINTR)
			throw std::runtime_error(std::string("lost a program: ") + std::strerror(errno));
	const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
	if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
	{
		std::string line;
		for (const std::string& word : command)
			line += word + " ";
		throw std::runtime_error(line + "failed in " + folder_name + ":\n" + LastWords(log));
	}
	return {Seconds(usage.ru_utime) + Seconds(usage.ru_stime), wall.count(), double(usage.ru_maxrss) / 1024};
}
